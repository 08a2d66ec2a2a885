// A folder for the files of runs of a decoder.
#pragma once

#include <filesystem>
#include <system_error>

namespace hmlfc::conform {

/// Removes what a decoder left at `path`, however deep: std::filesystem holds a descriptor for each
/// level and may run out of them, `rm` does not, and says what it cannot remove.
void remove_tree(const std::filesystem::path& path);

/// A new, empty folder `prefix`-XXXXXX, whose name nobody else has, removed at the end.
class WorkFolder {
 public:
  explicit WorkFolder(const std::filesystem::path& prefix);
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder();

  const std::filesystem::path& path() const { return path_; }
  /// Why it could not be created; false if it was.
  const std::error_code& error() const { return error_; }

 private:
  std::filesystem::path path_;
  std::error_code error_;
};

}  // namespace hmlfc::conform
