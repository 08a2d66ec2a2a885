// JSON files of the suite.
#pragma once

#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/json_members.hpp"

namespace hmlfc::vectors {

/// JSON with its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// An error in a recipe or a manifest. Thrown in this folder; public functions return it as an
/// IoError.
using io::TextError;

using io::Members;

/// A manifest or a file of recipes.
inline constexpr io::JsonLimits kSuiteLimits{"a suite's file", size_t{1} << 24, 16};

/// The JSON in `file`. Throws TextError naming the file and the place, and std::bad_alloc.
inline Json read_json(const std::filesystem::path& file) {
  auto json = io::read_json_file<Json>(file, kSuiteLimits);
  if (!json && json.error().out_of_memory) throw std::bad_alloc();
  if (!json) throw TextError(json.error().message);
  return std::move(*json);
}

}  // namespace hmlfc::vectors
