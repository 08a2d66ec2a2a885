// JSON files of the suite.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "io/files.hpp"

namespace hmlfc::vectors {

/// JSON with its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// An error in a recipe or a manifest. Thrown in this folder; public functions return it as an
/// IoError.
class TextError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The JSON in `file`. Throws TextError naming the file and the place.
inline Json read_json(const std::filesystem::path& file) {
  const auto mapped = io::map_file(file);
  if (!mapped) throw TextError(mapped.error().message);
  try {
    return Json::parse(mapped->bytes().begin(), mapped->bytes().end());
  } catch (const Json::exception& error) {
    throw TextError(file.string() + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
