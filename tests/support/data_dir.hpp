// Where the real light fields of the tests lie.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace hmlfc::test {

/// The folder `name` of HMLFC_DATA_DIR, or of ../shared/data beside the repository where that
/// variable is not set. Nothing if there is no such folder: the test then calls GTEST_SKIP().
inline std::optional<std::filesystem::path> real_data(const std::string& name) {
  const char* from_environment = std::getenv("HMLFC_DATA_DIR");
  const std::filesystem::path base =
      from_environment != nullptr ? from_environment : HMLFC_DEFAULT_DATA_DIR;
  const std::filesystem::path folder = base / name;
  if (!std::filesystem::is_directory(folder)) {
    return std::nullopt;
  }
  return folder;
}

}  // namespace hmlfc::test
