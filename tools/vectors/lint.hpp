// Checks of a suite that decode nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// What is wrong with the suite in `folder`, whose manifest is `manifest`, one line each: files
/// that are missing, whose sum differs, or that no vector names; ids that are not sorted, unique
/// and of their group; clauses and flags listed twice; profile, level or output shape that the
/// stream's header contradicts; a stream that is said to open and whose header, sections, index or
/// key image table break a rule; traces without count and end marker; blocks files of another
/// shape.
std::vector<std::string> lint_suite(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace hmlfc::vectors
