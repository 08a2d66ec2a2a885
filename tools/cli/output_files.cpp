#include "cli/output_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "cli/output.hpp"
#include "io/files.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {
namespace {

namespace fs = std::filesystem;

constexpr size_t kSignedBytes = 256;  // of a file's beginning, where a sign stands

[[noreturn]] void refuse(const fs::path& output, const std::string& what) {
  throw Failure(ExitCode::kUsage, output.string() + ": " + what);
}

bool is_standard_output(const fs::path& output) { return output == "-"; }

bool has_sign(const fs::path& file, std::string_view sign) {
  std::error_code failure;
  if (sign.empty() || !fs::is_regular_file(file, failure)) return false;  // a pipe has no end
  std::ifstream stream(file, std::ios::binary);
  std::array<char, kSignedBytes> begin{};
  stream.read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()).find(sign) != std::string_view::npos;
}

// Whether `file`, which is there, is `input` by whatever path or link, or a picture in that folder.
bool is_input(const fs::path& file, const fs::path& input) {
  std::error_code failure;
  if (!fs::is_directory(input, failure)) return fs::equivalent(file, input, failure);
  const fs::path real = fs::canonical(file, failure);
  return io::is_picture_name(real) && fs::equivalent(real.parent_path(), input, failure);
}

// Says that pictures in `folder` other than `files` stay, which would count as views of them.
void note_others(const fs::path& folder, const std::vector<std::string>& files) {
  const std::set<std::string> own(files.begin(), files.end());
  size_t count = 0;
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    if (io::is_picture_name(it->path()) && !own.contains(it->path().filename().string())) ++count;
  }
  if (count == 0) return;
  note(fmt::format("{}: {} other picture{} there, of an earlier result perhaps", folder.string(),
                   count, count == 1 ? " stays" : "s stay"));
}

}  // namespace

void check_replaceable(const std::vector<fs::path>& files, const Replacing& replacing) {
  const fs::path* first = nullptr;
  size_t count = 0;
  for (const fs::path& file : files) {
    std::error_code failure;
    if (!fs::exists(file, failure)) continue;
    for (const fs::path& input : replacing.inputs) {
      if (is_input(file, input)) refuse(file, "is also an input; choose another output");
    }
    if (replacing.force || has_sign(file, replacing.sign)) continue;
    if (count++ == 0) first = &file;
  }
  if (count == 0) return;
  refuse(*first, fmt::format("is there already{}, and nothing says that this command wrote it; "
                             "--force replaces it, or choose another output",
                             count == 1 ? "" : fmt::format(", as {} more are", count - 1)));
}

void check_extension(const fs::path& output, std::string_view what,
                     const std::vector<std::string_view>& own) {
  constexpr std::array<std::string_view, 24> kOthers = {
      ".apng", ".avi", ".bmp",  ".exr", ".gif",  ".hmlfc", ".jpeg", ".jpg",
      ".json", ".mkv", ".mov",  ".mp4", ".pfm",  ".pgm",   ".png",  ".pnm",
      ".ppm",  ".tif", ".tiff", ".txt", ".webm", ".webp",  ".y4m",  ".zip"};
  const std::string extension = io::lower_case_extension(output);
  if (std::ranges::find(own, extension) != own.end() ||
      std::ranges::find(kOthers, extension) == kOthers.end()) {
    return;
  }
  refuse(output, fmt::format("{} is written here, not {}; choose another name", what, extension));
}

OutputFile::OutputFile(const fs::path& output, const std::string& extension,
                       const Replacing& replacing)
    : path_(output), is_standard_(is_standard_output(output)) {
  if (!is_standard_) {
    value_or_throw(io::AtomicFile::create(output), ExitCode::kUsage);
    check_replaceable({output}, replacing);
    return;
  }
  if (::isatty(STDOUT_FILENO) == 1) refuse(output, "standard output is a terminal; name a file");
  std::string name = (fs::temp_directory_path() / "hmlfc-XXXXXX").string() + extension;
  const io::FileDescriptor made(::mkstemps(name.data(), static_cast<int>(extension.size())));
  if (made.get() < 0) refuse(name, "cannot make a temporary file");
  path_ = name;
  print_to_standard_error();
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (is_standard_) fs::remove(path_, ignored);
}

void OutputFile::finish() const {
  if (is_standard_)
    write_standard_output(value_or_throw(io::map_file(path_), ExitCode::kOutput).bytes());
}

OutputFile picture_file(const fs::path& output, const Replacing& replacing) {
  if (extension_of(output, ".png") != ".png") {
    refuse(output, "pictures are PNG files; name it *.png");
  }
  return {output, ".png", replacing};
}

std::string extension_of(const fs::path& output, const std::string& standard) {
  return is_standard_output(output) ? standard : io::lower_case_extension(output);
}

void make_output_folder(const fs::path& folder, const std::vector<std::string>& files,
                        const Replacing& replacing) {
  if (is_standard_output(folder)) refuse(folder, "standard output takes one file; name a folder");
  std::error_code failure;
  for (const fs::path& input : replacing.inputs) {
    if (fs::is_directory(input, failure) && fs::equivalent(folder, input, failure)) {
      refuse(folder, "is also the input; choose another output");
    }
  }
  std::vector<fs::path> paths;
  for (const std::string& file : files) paths.push_back(folder / file);
  check_replaceable(paths, replacing);
  fs::create_directories(folder, failure);
  if (failure) refuse(folder, "cannot create this folder: " + failure.message());
  if (files.size() > 1) note_others(folder, files);
}

io::FolderLock take_output_folder(const fs::path& folder) {
  make_output_folder(folder);
  return value_or_throw(io::FolderLock::take(folder), ExitCode::kUsage);
}

}  // namespace hmlfc::cli
