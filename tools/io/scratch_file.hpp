// A temporary file without a name, gone with the process.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

#include "io/files.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

/// Grows at its end and is read anywhere, by any number of threads.
class ScratchFile {
 public:
  /// Makes it in `folder` and removes its name at once. Errors: the folder cannot be written.
  static IoResult<ScratchFile> create(const std::filesystem::path& folder);

  ScratchFile(ScratchFile&& other) noexcept
      : folder_(std::move(other.folder_)),
        file_(std::move(other.file_)),
        size_(other.size_.load()) {}

  /// Appends `bytes`; returns where they begin. Errors: full disk, device error.
  IoResult<uint64_t> append(std::span<const uint8_t> bytes);

  /// Fills `out` from byte `offset` on. Errors: device error; the bytes were not appended.
  IoResult<void> read(uint64_t offset, std::span<uint8_t> out) const;

 private:
  ScratchFile(std::filesystem::path folder, FileDescriptor file)
      : folder_(std::move(folder)), file_(std::move(file)) {}

  std::filesystem::path folder_;
  FileDescriptor file_;
  std::atomic<uint64_t> size_ = 0;
};

}  // namespace hmlfc::io
