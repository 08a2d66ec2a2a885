#include "io/file_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>

namespace hmlfc::io {

IoResult<std::unique_ptr<FileSource>> FileSource::open(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a named pipe would wait for a writer.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) {
    return system_error(path, "cannot open for reading", errno);
  }
  if (!S_ISREG(status.st_mode)) {
    return file_error(path, "not a regular file; give a file's name");
  }
  std::unique_ptr<FileSource> source(
      new FileSource(path, std::move(file), static_cast<uint64_t>(status.st_size)));
  if (!source->is_reserved()) return memory_error(path, "to read a file of this length");
  return source;
}

std::string FileSource::fetch(std::span<const ByteRange> ranges) {
  for (const ByteRange& range : ranges) {
    const auto to = room(range);
    for (size_t done = 0; done < to.size();) {
      const ssize_t count = ::pread(file_.get(), to.data() + done, to.size() - done,
                                    static_cast<off_t>(range.offset + done));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return system_error(path_, "cannot read", errno).value().message;
      if (count == 0) return path_.string() + ": became shorter while it was read; open it anew";
      done += static_cast<size_t>(count);
    }
  }
  return {};
}

}  // namespace hmlfc::io
