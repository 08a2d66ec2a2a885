// The files and folders that a command writes, and what it may replace there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/folder_lock.hpp"

namespace hmlfc::cli {

/// What stands in the first bytes of a stream, and of a video that this program wrote. Its pictures
/// have the name of the command there, "hmlfc decode".
inline constexpr std::string_view kStreamSign = "HMLFC\r\n";
inline constexpr std::string_view kVideoSign = "XHMLFC=";

/// Files that a command may replace: those with its sign.
struct Replacing {
  std::string_view sign;  ///< empty: none
  bool force = false;     ///< also any others
  std::vector<std::filesystem::path> inputs =
      {};  ///< but never these, nor pictures in folders here
};

/// Usage failure where one of `files` is there and may not be replaced.
void check_replaceable(const std::vector<std::filesystem::path>& files, const Replacing& replacing);

/// Usage failure for a name of a picture, video or text format other than `own`, which are
/// extensions in small letters; `what` says what is written: "a stream".
void check_extension(const std::filesystem::path& output, std::string_view what,
                     const std::vector<std::string_view>& own);

/// The one file that a command writes: at a path, or for "-" on standard output, by way of a
/// temporary file. Then all that is printed goes to standard error.
class OutputFile {
 public:
  /// `extension` is that of the temporary file. Usage failure where no file can be written, or one
  /// may not be replaced; leaves nothing there.
  OutputFile(const std::filesystem::path& output, const std::string& extension,
             const Replacing& replacing);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Where to write it.
  const std::filesystem::path& path() const { return path_; }

  /// Once it is written. Failure (kOutput) where standard output cannot be written.
  void finish() const;

 private:
  std::filesystem::path path_;
  bool is_standard_ = false;
};

/// One file that is a PNG, and is named *.png or "-".
OutputFile picture_file(const std::filesystem::path& output, const Replacing& replacing);

/// The extension by which the format of `output` is known: ".png" of "a.PNG"; `standard` of "-".
std::string extension_of(const std::filesystem::path& output, const std::string& standard);

/// Makes `folder` and its missing parents. Failure (kUsage) where that is impossible, or where one
/// of `files`, names in the folder, may not be replaced.
void make_output_folder(const std::filesystem::path& folder,
                        const std::vector<std::string>& files = {},
                        const Replacing& replacing = {});

/// Makes the folder, and holds it against other processes. Failure (kUsage) where one uses it.
io::FolderLock take_output_folder(const std::filesystem::path& folder);

}  // namespace hmlfc::cli
