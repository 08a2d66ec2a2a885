// What one vector of the suite tests, in words.
#pragma once

#include <filesystem>
#include <string>

#include "vectors/manifest.hpp"

namespace hmlfc::cli {

/// "ok", "reject bad_mode", or of a camera "reject focal".
std::string expectation_text(const vectors::Expectation& expect);

/// The mistake that `vector` hunts, what must come of it, and its recipe in `suite`. Failures:
/// kInput where that cannot be read.
std::string explanation(const std::filesystem::path& suite, const vectors::Vector& vector);

}  // namespace hmlfc::cli
