// A folder held by a file that nobody else can open, and that is gone once it is closed.
#include "io/folder_lock.hpp"

#include <windows.h>

#include <fcntl.h>
#include <io.h>

#include <cerrno>
#include <string>

namespace hmlfc::io {

IoResult<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  std::filesystem::path path = folder / ".hmlfc-lock";
  const HANDLE held =
      ::CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS,
                    FILE_ATTRIBUTE_NORMAL | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
  if (held == INVALID_HANDLE_VALUE && ::GetLastError() == ERROR_SHARING_VIOLATION) {
    return file_error(folder,
                      "in use by another process; wait for its end, or choose another folder");
  }
  if (held == INVALID_HANDLE_VALUE)
    return system_error(path, "cannot be made; give another folder", EACCES);
  FileDescriptor file(::_open_osfhandle(reinterpret_cast<intptr_t>(held), _O_BINARY));
  return FolderLock(std::move(path), std::move(file));
}

FolderLock::~FolderLock() = default;

}  // namespace hmlfc::io
