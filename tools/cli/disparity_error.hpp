// How far a map of disparities is from another one, such as the truth.
#pragma once

#include <filesystem>
#include <optional>

#include <hmlfc/decoder.hpp>

#include "cli/output.hpp"

namespace hmlfc::cli {

/// Compares the PFM files `a` and `b`, or `rect` of them, and prints the error, as JSON if `json`.
/// Returns kDone for equal numbers, else kDifferent. Failures: a file that is no grey PFM, other
/// sides, nothing known in both (kInput); `rect` does not lie in them (kUsage).
ExitCode compare_maps(const std::filesystem::path& a, const std::filesystem::path& b,
                      const std::optional<Rect>& rect, bool json);

}  // namespace hmlfc::cli
