// A folder for the files of one run of a decoder.
#pragma once

#include <filesystem>
#include <system_error>
#include <utility>

namespace hmlfc::conform {

/// An empty folder, created if missing, removed at the end unless kept.
class WorkFolder {
 public:
  explicit WorkFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    std::filesystem::create_directories(path_, error_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  /// Why it could not be created; false if it was.
  const std::error_code& error() const { return error_; }

  void keep() { kept_ = true; }

 private:
  std::filesystem::path path_;
  std::error_code error_;
  bool kept_ = false;
};

}  // namespace hmlfc::conform
