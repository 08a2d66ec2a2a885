// What Windows gives of memory, in place of POSIX.
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <utility>
#include <vector>

#include "bits/mapped_file.hpp"
#include "bits/sparse_bytes.hpp"

namespace hmlfc {
namespace {

struct Closer {
  void operator()(HANDLE handle) const { ::CloseHandle(handle); }
};
using Handle = std::unique_ptr<void, Closer>;

// The error of errno that is nearest to the last one of Windows.
int nearest_errno() {
  switch (::GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
      return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
      return EACCES;
    case ERROR_NOT_ENOUGH_MEMORY:
    case ERROR_COMMITMENT_LIMIT:
      return ENOMEM;
    default:
      return EIO;
  }
}

tl::unexpected<MapFailure> refused(const char* reason) {
  return tl::unexpected(MapFailure{reason, nearest_errno()});
}

// A name in UTF-8, as every name of this library is, in Windows' own form; not UTF-8: empty.
std::vector<wchar_t> wide(const char* name) {
  const auto convert = [&](wchar_t* to, int room) {
    return ::MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, name, -1, to, room);
  };
  std::vector<wchar_t> text(static_cast<size_t>(convert(nullptr, 0)) + 1);
  convert(text.data(), static_cast<int>(text.size()));
  return text;
}

}  // namespace

tl::expected<MappedFile, MapFailure> MappedFile::open(const char* path) {
  // Others may open the file meanwhile, but not replace it: Windows refuses that while it is
  // mapped.
  const HANDLE opened = ::CreateFileW(wide(path).data(), GENERIC_READ,
                                      FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                      nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (opened == INVALID_HANDLE_VALUE) return refused("cannot open for reading");
  const Handle file(opened);
  if (::GetFileType(opened) != FILE_TYPE_DISK) {
    return tl::unexpected(MapFailure{"not a regular file; give a file's name", 0});
  }
  LARGE_INTEGER size = {};
  if (::GetFileSizeEx(opened, &size) == 0) return refused("cannot read");
  if (size.QuadPart == 0) return MappedFile({});
  // The view keeps the mapping, and the mapping the file.
  const Handle mapping(::CreateFileMappingW(opened, nullptr, PAGE_READONLY, 0, 0, nullptr));
  const void* data = mapping ? ::MapViewOfFile(mapping.get(), FILE_MAP_READ, 0, 0, 0) : nullptr;
  if (data == nullptr) return refused("cannot map into memory");
  return MappedFile({static_cast<const uint8_t*>(data), static_cast<size_t>(size.QuadPart)});
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

void MappedFile::drop_pages() const {
  // Of pages that are not locked, this takes them out of the working set.
  if (!bytes_.empty()) ::VirtualUnlock(const_cast<uint8_t*>(bytes_.data()), bytes_.size());
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::UnmapViewOfFile(bytes_.data());
}

// Windows answers for all of it, in memory or its page file, before it is written to.
Reservation::Reservation(uint64_t bytes)
    : bytes_(static_cast<size_t>(std::clamp<uint64_t>(bytes, 1, SIZE_MAX))),
      data_(static_cast<uint8_t*>(
          ::VirtualAlloc(nullptr, bytes_, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE))) {}

Reservation::~Reservation() {
  if (data_ != nullptr) ::VirtualFree(data_, 0, MEM_RELEASE);
}

void Reservation::clear(uint64_t offset, uint64_t bytes) {
  const auto size = static_cast<size_t>(std::min<uint64_t>(bytes, bytes_ - offset));
  ::VirtualFree(data_ + offset, size, MEM_DECOMMIT);
  ::VirtualAlloc(data_ + offset, size, MEM_COMMIT, PAGE_READWRITE);
}

}  // namespace hmlfc
