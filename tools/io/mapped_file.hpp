// A file's bytes, read through the page cache without a copy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// Read-only view of a whole regular file for as long as the object lives. The file must not be
/// shortened meanwhile (the system then ends the process); files replaced by rename are safe.
class MappedFile {
 public:
  /// Errors: the file does not exist, cannot be read, or is no regular file.
  static IoResult<MappedFile> open(const std::filesystem::path& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  /// All bytes of the file; an empty span for an empty file.
  std::span<const uint8_t> bytes() const { return {data_, size_}; }

 private:
  MappedFile(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  const uint8_t* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace hmlfc::io
