// A file that is read as it is needed.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "bits/sparse_source.hpp"
#include "io/files.hpp"

namespace hmlfc::io {

/// Ranges of a file, read into memory when they are needed. Unlike a mapped file it may become
/// shorter, which is a failure of the source: no signal ends the program.
class FileSource final : public SparseSource {
 public:
  /// Errors: the file does not exist, cannot be read, or is no regular file; no address space for a
  /// file of this length.
  static IoResult<std::unique_ptr<FileSource>> open(const std::filesystem::path& path);

 private:
  FileSource(std::filesystem::path path, FileDescriptor file, uint64_t size)
      : SparseSource(size, {}), path_(std::move(path)), file_(std::move(file)) {}

  std::string fetch(std::span<const ByteRange> ranges) override;

  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace hmlfc::io
