// One process at a time in a folder of outputs.
#pragma once

#include <filesystem>
#include <utility>

#include "io/files.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

/// Holds a folder against other processes: a lock on its file .hmlfc-lock, which the end of the
/// process frees, however it ends. The file is removed at the end of the object. Two objects of one
/// process do not keep each other out, nor do processes where the file system has no locks.
class FolderLock {
 public:
  /// Errors: another process holds it, whose number is named; no file can be made there.
  static IoResult<FolderLock> take(const std::filesystem::path& folder);

  FolderLock(FolderLock&&) noexcept = default;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  FolderLock(std::filesystem::path path, FileDescriptor file)
      : path_(std::move(path)), file_(std::move(file)) {}

  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace hmlfc::io
