// A folder for the files of runs of a decoder.
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace hmlfc::conform {

/// A new, empty folder `prefix`-XXXXXX, whose name nobody else has, removed at the end.
class WorkFolder {
 public:
  explicit WorkFolder(const std::filesystem::path& prefix) : path_(prefix) {
    std::filesystem::create_directories(prefix.parent_path(), error_);
    if (error_) return;
    std::string name = prefix.string() + "-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
      error_ = {errno, std::generic_category()};
    } else {
      path_ = name;
    }
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    if (!error_) std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  /// Why it could not be created; false if it was.
  const std::error_code& error() const { return error_; }

 private:
  std::filesystem::path path_;
  std::error_code error_;
};

}  // namespace hmlfc::conform
