// Files mapped for reading, and output files that appear complete or not at all.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "bits/mapped_file.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

/// ASCII letters in lower case.
std::string lower_case(std::string text);

/// ".png" of "a/B.PNG".
std::string lower_case_extension(const std::filesystem::path& file);

/// The file `name`, in lower case, of a folder, else one whose name differs in case alone; empty
/// without both.
std::filesystem::path file_named(const std::filesystem::path& folder, std::string_view name);

/// Closes its descriptor on destruction; empty (-1) after a move or release().
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept : descriptor_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  int get() const { return descriptor_; }
  int release() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_ = -1;
};

/// NAME.partial-XXXXXXXXXXXX next to `target`, with random digits: no other process has the name,
/// on whatever machine that shares the disk.
std::filesystem::path partial_name(const std::filesystem::path& target);

/// Writes to a file without a name, which becomes the target on commit(). Until then, and after any
/// failure, the target is unchanged; without a commit(), or when the process ends, nothing is left.
/// Where the file system has no such files, the file is called partial_name() of the target
/// meanwhile, and stays when the process is killed.
///
///   auto file = AtomicFile::create("a.hmlfc");
///   if (file && file->write(header) && file->write(body)) return file->commit();
class AtomicFile {
 public:
  /// Errors: the folder does not exist or cannot be written, or the target exists and is not a
  /// regular file (a device or a folder is never replaced), or is write-protected. A symbolic
  /// link's target is replaced, not the link; permissions stay.
  static IoResult<AtomicFile> create(const std::filesystem::path& target);

  AtomicFile(AtomicFile&&) noexcept = default;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Appends all of `bytes`. Errors: full disk, size limit, device error.
  IoResult<void> write(std::span<const uint8_t> bytes);

  /// Flushes to the device and replaces the target; nothing may be written afterwards. Errors as
  /// write().
  IoResult<void> commit();

 private:
  AtomicFile(std::filesystem::path target, std::filesystem::path partial, FileDescriptor file,
             bool has_name)
      : target_(std::move(target)),
        partial_(std::move(partial)),
        file_(std::move(file)),
        has_name_(has_name) {}

  std::filesystem::path target_;
  std::filesystem::path partial_;
  FileDescriptor file_;
  bool has_name_;  // partial_, from the start
};

/// The whole file at once: create, write, commit.
IoResult<void> write_file(const std::filesystem::path& target, std::span<const uint8_t> bytes);

/// As MappedFile::open; the error says so in words.
IoResult<MappedFile> map_file(const std::filesystem::path& path);

}  // namespace hmlfc::io
