#include "io/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hmlfc::io {

namespace fs = std::filesystem;

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string lower_case_extension(const fs::path& file) {
  return lower_case(file.extension().string());
}

fs::path file_named(const fs::path& folder, std::string_view name) {
  fs::path found;
  std::error_code failure;
  for (fs::directory_iterator i(folder, failure), end; !failure && i != end; i.increment(failure)) {
    const std::string file = i->path().filename().string();
    if (file == name) return i->path();
    if (lower_case(file) == name && (found.empty() || i->path() < found)) found = i->path();
  }
  return found;
}

fs::path partial_name(const fs::path& target) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::random_device random;
  fs::path name = target.parent_path() / target.filename().string().substr(0, 230);
  name += ".partial-";
  for (int i = 0; i < 12; ++i) name += kDigits[random() % 16];
  return name;
}

namespace {

std::string path_of(const FileDescriptor& file) {
  return "/proc/self/fd/" + std::to_string(file.get());
}

// A file without a name on the disk of `target`, which is gone with the process, however that ends;
// none where the file system has no such files.
FileDescriptor nameless_file(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  FileDescriptor file(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (file.get() >= 0 && ::access(path_of(file).c_str(), F_OK) != 0) return {};
  return file;
}

}  // namespace

IoResult<AtomicFile> AtomicFile::create(const fs::path& target) {
  if (!target.has_filename()) return file_error(target, "not a file name; give the output a name");
  std::error_code failure;
  const fs::file_status status = fs::status(target, failure);
  if (status.type() == fs::file_type::none) {
    return system_error(target, "cannot be used; choose another output name", failure.value());
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return file_error(target, "exists and is not a regular file; choose another output name");
  }
  fs::path resolved = target;
  if (fs::is_symlink(fs::symlink_status(target, failure))) {
    if (!fs::exists(status)) {
      return file_error(target, "a link to a file that is not there; choose another output name");
    }
    resolved = fs::canonical(target, failure);
    if (failure) return system_error(target, "cannot follow the link", failure.value());
  }
  if (fs::exists(status) && ::access(resolved.c_str(), W_OK) != 0) {
    return system_error(target, "cannot be replaced; choose another output name", errno);
  }

  fs::path partial = partial_name(resolved);
  FileDescriptor file = nameless_file(resolved);
  const bool has_name = file.get() < 0;
  if (has_name) {
    file = FileDescriptor(::open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  }
  if (file.get() < 0) {
    return system_error(target, "cannot write here (is the folder there and writable?)", errno);
  }
  if (fs::exists(status)) ::fchmod(file.get(), static_cast<mode_t>(status.permissions()) & 0777);
  return AtomicFile(std::move(resolved), std::move(partial), std::move(file), has_name);
}

AtomicFile::~AtomicFile() {
  if (file_.get() >= 0 && has_name_) ::unlink(partial_.c_str());
}

IoResult<void> AtomicFile::write(std::span<const uint8_t> bytes) {
  constexpr size_t kLargestWrite = size_t{1} << 30;  // Linux writes at most 2^31 - 4096 at once
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_.get(), bytes.data(), std::min(bytes.size(), kLargestWrite));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_error(target_, "cannot write; the file was left as it was", errno);
    bytes = bytes.subspan(static_cast<size_t>(count));
  }
  return {};
}

IoResult<void> AtomicFile::commit() {
  constexpr const char* kFailed = "cannot finish writing; the file was left as it was";
  if (::fsync(file_.get()) != 0) return system_error(target_, kFailed, errno);
  if (!has_name_ && ::linkat(AT_FDCWD, path_of(file_).c_str(), AT_FDCWD, partial_.c_str(),
                             AT_SYMLINK_FOLLOW) != 0) {
    return system_error(target_, kFailed, errno);
  }
  // A network file system may report a full disk only on close.
  const int descriptor = file_.release();
  if (::close(descriptor) != 0 || ::rename(partial_.c_str(), target_.c_str()) != 0) {
    const int reason = errno;
    ::unlink(partial_.c_str());
    return system_error(target_, kFailed, reason);
  }
  return {};
}

IoResult<void> write_file(const fs::path& target, std::span<const uint8_t> bytes) {
  return AtomicFile::create(target).and_then([bytes](AtomicFile file) {
    return file.write(bytes).and_then([&file] { return file.commit(); });
  });
}

IoResult<MappedFile> map_file(const fs::path& path) {
  auto mapped = MappedFile::open(path.string().c_str());
  if (mapped) return std::move(*mapped);
  const auto [reason, number] = mapped.error();
  return number == 0 ? file_error(path, reason) : system_error(path, reason, number);
}

}  // namespace hmlfc::io
