// What POSIX gives of memory; fallback/windows has the same for Windows.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <utility>

#include "bits/mapped_file.hpp"
#include "bits/sparse_bytes.hpp"

namespace hmlfc {
namespace {

tl::expected<std::span<const uint8_t>, MapFailure> map_descriptor(int file) {
  struct stat status = {};
  if (::fstat(file, &status) != 0) return tl::unexpected(MapFailure{"cannot read", errno});
  if (!S_ISREG(status.st_mode)) {
    return tl::unexpected(MapFailure{"not a regular file; give a file's name", 0});
  }
  const auto size = static_cast<size_t>(status.st_size);
  if (size == 0) return std::span<const uint8_t>();
  const void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (data == MAP_FAILED) return tl::unexpected(MapFailure{"cannot map into memory", errno});
  return std::span(static_cast<const uint8_t*>(data), size);
}

}  // namespace

tl::expected<MappedFile, MapFailure> MappedFile::open(const char* path) {
  // Without O_NONBLOCK, opening a named pipe would wait for a writer.
  const int file = ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return tl::unexpected(MapFailure{"cannot open for reading", errno});
  const auto bytes = map_descriptor(file);
  ::close(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return MappedFile(*bytes);
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

void MappedFile::drop_pages() const {
  if (!bytes_.empty()) {
    ::madvise(const_cast<uint8_t*>(bytes_.data()), bytes_.size(), MADV_DONTNEED);
  }
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<uint8_t*>(bytes_.data()), bytes_.size());
}

Reservation::Reservation(uint64_t bytes)
    : bytes_(static_cast<size_t>(std::clamp<uint64_t>(bytes, 1, SIZE_MAX))), data_(nullptr) {
  void* data = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (data != MAP_FAILED) data_ = static_cast<uint8_t*>(data);
}

Reservation::~Reservation() {
  if (data_ != nullptr) ::munmap(data_, bytes_);
}

void Reservation::clear(uint64_t offset, uint64_t bytes) {
  ::madvise(data_ + offset, static_cast<size_t>(bytes), MADV_DONTNEED);
}

}  // namespace hmlfc
