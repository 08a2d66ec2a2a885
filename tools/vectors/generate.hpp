// Generates the suite from its recipes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/io_error.hpp"
#include "io/parallel.hpp"
#include "vectors/manifest.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::vectors {

/// Version of the suite (vectors/CHANGES.md).
inline constexpr const char* kVectorsVersion = "3.5.0";

/// Version of its frames.
inline constexpr const char* kFramesVersion = "1.2.0";

/// Files of a suite by their name in its folder.
using SuiteFiles = std::map<std::string, std::vector<uint8_t>>;

/// One vector with its files, without milestone and base. Throws TextError where the golden model
/// contradicts the recipe.
Vector make_vector(const Recipes& recipes, const std::string& id, SuiteFiles& files);

/// Makes all vectors of `recipes` in memory, and manifest.json, on `threads` threads (0: all
/// cores). The bytes are the same for any number of threads and on every machine. Errors: of the
/// recipes, or a recipe whose expectation the golden model contradicts.
io::IoResult<SuiteFiles> generate_suite(const std::filesystem::path& recipes, unsigned threads,
                                        const io::Progress& progress = {});

/// Writes `files` into `folder`, and removes what an earlier manifest there names and `files` does
/// not have. Errors: cannot write.
io::IoResult<void> write_suite(const SuiteFiles& files, const std::filesystem::path& folder);

}  // namespace hmlfc::vectors
