// Where the real light fields of benchmarks and tests are.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace hmlfc {

/// The folder `name` of HMLFC_DATA_DIR, or of ../shared/data beside the repository if that variable
/// is not set. It need not exist.
inline std::filesystem::path data_folder(const std::string& name) {
  const char* from_environment = std::getenv("HMLFC_DATA_DIR");
  return std::filesystem::path(from_environment ? from_environment : HMLFC_DEFAULT_DATA_DIR) / name;
}

/// The same. Nothing if there is no such folder: the test then calls GTEST_SKIP().
inline std::optional<std::filesystem::path> real_data(const std::string& name) {
  const std::filesystem::path folder = data_folder(name);
  return std::filesystem::is_directory(folder) ? std::optional(folder) : std::nullopt;
}

}  // namespace hmlfc
