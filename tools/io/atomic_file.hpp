// An output file that appears complete or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "io/file_descriptor.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

/// Writes beside the target, into NAME.partial-<process id>, and renames on commit(). Until then,
/// and after any failure, the target is what it was before; without a commit() the partial file is
/// removed. One writer per target within a process.
///
///   auto file = AtomicFile::create("a.hmlfc");
///   if (file && file->write(header) && file->write(body)) return file->commit();
class AtomicFile {
 public:
  /// Errors: the folder does not exist or cannot be written, or the target exists and is no regular
  /// file (a device or a folder is never replaced). A symbolic link's target is replaced, not the
  /// link.
  static IoResult<AtomicFile> create(const std::filesystem::path& target);

  AtomicFile(AtomicFile&&) noexcept = default;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Appends all of `bytes`. Errors: full disk, size limit, device error.
  IoResult<void> write(std::span<const uint8_t> bytes);

  /// Flushes to the device and renames; the object is then finished. Errors as write().
  IoResult<void> commit();

 private:
  AtomicFile(std::filesystem::path target, std::filesystem::path partial, FileDescriptor file)
      : target_(std::move(target)), partial_(std::move(partial)), file_(std::move(file)) {}

  std::filesystem::path target_;
  std::filesystem::path partial_;
  FileDescriptor file_;
};

/// The whole file at once: create, write, commit.
IoResult<void> write_file(const std::filesystem::path& target, std::span<const uint8_t> bytes);

}  // namespace hmlfc::io
