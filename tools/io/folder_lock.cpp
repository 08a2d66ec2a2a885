#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace hmlfc::io {
namespace {

// A lock of this process, which its children do not inherit.
struct flock whole_file() {
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

tl::unexpected<IoError> in_use(const std::filesystem::path& folder, int file) {
  struct flock holder = whole_file();
  const bool known = ::fcntl(file, F_GETLK, &holder) == 0 && holder.l_pid > 0;
  return file_error(folder, (known ? "in use by process " + std::to_string(holder.l_pid)
                                   : std::string("in use by another process")) +
                                "; wait for its end, or choose another folder");
}

// Whether `path` still is the open file, which its holder may have removed before it was locked.
bool is_at(const std::filesystem::path& path, int file) {
  struct stat opened = {};
  struct stat there = {};
  return ::fstat(file, &opened) == 0 && ::lstat(path.c_str(), &there) == 0 &&
         opened.st_ino == there.st_ino && opened.st_dev == there.st_dev;
}

}  // namespace

IoResult<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  std::filesystem::path path = folder / ".hmlfc-lock";
  for (;;) {
    FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (file.get() < 0) return system_error(path, "cannot be made; give another folder", errno);
    const struct flock lock = whole_file();
    if (::fcntl(file.get(), F_SETLK, &lock) != 0 && (errno == EAGAIN || errno == EACCES)) {
      return in_use(folder, file.get());
    }
    if (is_at(path, file.get())) return FolderLock(std::move(path), std::move(file));
  }
}

FolderLock::~FolderLock() {
  if (file_.get() >= 0) ::unlink(path_.c_str());
}

}  // namespace hmlfc::io
