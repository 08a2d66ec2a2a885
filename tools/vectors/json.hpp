// JSON files of the suite.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "io/io_error.hpp"

namespace hmlfc::vectors {

/// JSON with its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// What is wrong with a recipe or a manifest. Thrown in this folder; public functions return it as
/// an IoError.
class TextError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The JSON in `file`. Throws TextError naming the file and the place.
Json read_json(const std::filesystem::path& file);

}  // namespace hmlfc::vectors
