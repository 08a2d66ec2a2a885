#include "io/scratch_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace hmlfc::io {

IoResult<ScratchFile> ScratchFile::create(const std::filesystem::path& folder) {
  std::string name = (folder / ".hmlfc-scratch-XXXXXX").string();
  FileDescriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (file.get() < 0) return system_error(folder, "cannot make a temporary file here", errno);
  ::unlink(name.c_str());
  return ScratchFile(folder, std::move(file));
}

IoResult<uint64_t> ScratchFile::append(std::span<const uint8_t> bytes) {
  const uint64_t offset = size_.fetch_add(bytes.size());
  uint64_t at = offset;
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      return system_error(folder_, "cannot write a temporary file here; nothing was written",
                          errno);
    }
    bytes = bytes.subspan(static_cast<size_t>(count));
    at += static_cast<uint64_t>(count);
  }
  return offset;
}

IoResult<void> ScratchFile::read(uint64_t offset, std::span<uint8_t> out) const {
  while (!out.empty()) {
    const ssize_t count = ::pread(file_.get(), out.data(), out.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      return system_error(folder_, "cannot read a temporary file here", count < 0 ? errno : EIO);
    }
    out = out.subspan(static_cast<size_t>(count));
    offset += static_cast<uint64_t>(count);
  }
  return {};
}

}  // namespace hmlfc::io
