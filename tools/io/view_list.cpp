#include "io/view_list.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "io/files.hpp"
#include "io/view_mosaic.hpp"
#include "io/view_reading.hpp"

namespace hmlfc::io {

namespace fs = std::filesystem;

namespace {

// A folder with no more pictures may hold its views in subfolders.
constexpr size_t kFewPictures = 4;
constexpr size_t kMostPlaces = 256;  // where views are looked for instead
constexpr size_t kMostPictures = size_t{kMaxGridSide} * kMaxGridSide;

// Adds the pictures right in `folder`, with names after `prefix`, and its subfolders to lists.
IoResult<void> list_folder(const fs::path& folder, const std::string& prefix,
                           std::vector<NamedPicture>& pictures, std::vector<fs::path>& folders) {
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    std::error_code ignored;
    const fs::path& path = it->path();
    const std::string name = path.filename().string();
    if (it->is_directory(ignored)) {
      if (!name.starts_with('.') && name != "__MACOSX") folders.push_back(path);
    } else if (is_picture_name(path)) {
      pictures.push_back({path, prefix + path.stem().string(), {}});
      if (pictures.size() > kMostPictures) return file_error(folder, "more pictures than any grid");
    }
  }
  if (failure) return system_error(folder, "cannot list the folder", failure.value());
  return {};
}

// The views right in `folder`, or in its subfolders.
IoResult<ViewList> views_of(const fs::path& folder, const ViewNaming& naming) {
  std::vector<NamedPicture> pictures;
  std::vector<fs::path> folders;
  if (auto ok = list_folder(folder, "", pictures, folders); !ok) return tl::unexpected(ok.error());
  auto list = read_names(folder, naming, pictures);
  if (list || pictures.size() > kFewPictures) return list;

  const size_t above = pictures.size();
  // Folders of rows, or of rows that hold folders of columns.
  for (int depth = 0; depth < 2 && pictures.size() == above; ++depth) {
    std::vector<fs::path> deeper;
    for (const fs::path& row : std::exchange(folders, {})) {
      const std::string prefix = row.lexically_relative(folder).string() + "/";
      auto ok = list_folder(row, prefix, pictures, deeper);
      if (!ok) return tl::unexpected(ok.error());
    }
    if (deeper.size() <= kMaxGridSide) folders = std::move(deeper);
  }
  if (pictures.size() == above) return list;
  return read_names(folder, naming, std::move(pictures));
}

// "; a.bmp is of a kind that is not read; ...": the first file that may hold views, where `folder`
// has hardly any pictures.
std::string other_files(const fs::path& folder) {
  constexpr std::string_view kPictures =
      " .arw .avif .bmp .cr2 .dng .exr .gif .hdr .heic .jp2 .jxl .lfp .lfr .tga ";
  const auto advice = [&](const fs::path& file) -> std::string_view {
    const std::string extension = lower_case_extension(file);
    if (extension.empty()) return "";
    if (kPictures.find(" " + extension + " ") != kPictures.npos) {
      return "is of a kind that is not read; convert it to PNG";
    }
    if (extension == ".zip" || extension == ".7z" || extension == ".tar" || extension == ".gz") {
      return "is an archive; unpack it";
    }
    if (extension == ".hmlfc") return "is a stream already";
    if (extension == ".y4m" || (is_picture_name(file) && parse_quilt_name(file))) {
      return "holds all views; give its name, not that of the folder";
    }
    return is_other_video(file) ? "is a video; ffmpeg -i VIDEO OUT.y4m makes one to read" : "";
  };
  fs::path first;
  size_t pictures = 0;
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    const fs::path name = it->path().filename();
    if (is_picture_name(name) && ++pictures > kFewPictures) return "";
    if (!advice(name).empty() && (first.empty() || name < first)) first = name;
  }
  return first.empty() ? "" : fmt::format("; {} {}", first.string(), advice(first));
}

// "; scene/views holds 3x3 views": the first folder below `folder`, else the one above, that may be
// meant instead; empty where none is.
std::string elsewhere(const fs::path& folder, const ViewNaming& naming) {
  if (!naming.pattern.empty()) return "";
  std::vector<fs::path> places{folder};
  const auto text_of = [&](const fs::path& place) {
    const auto list = views_of(place, naming);
    if (!list) return std::string();
    return fmt::format("; {} holds {}x{} views", place.lexically_normal().string(), list->rows,
                       list->cols);
  };
  for (size_t i = 0; i < std::min(places.size(), kMostPlaces); ++i) {
    std::vector<NamedPicture> ignored;
    std::vector<fs::path> below;
    if (auto text = i == 0 ? "" : text_of(places[i]); !text.empty()) return text;
    if (!list_folder(places[i], "", ignored, below)) continue;
    std::ranges::sort(below);
    places.insert(places.end(), below.begin(), below.end());
  }
  std::vector<NamedPicture> ignored;
  std::vector<fs::path> beside;
  const fs::path above = folder / "..";
  if (!list_folder(above, "", ignored, beside) || beside.size() > kMostPlaces) return "";
  return text_of(above);
}

uint32_t length(const IndexRange& range) { return (range.last - range.first) / range.step + 1; }

// "row 17, but the grid has 17 rows (0 to 16)" where `range` ends beyond `count` rows; `unit` is
// "row" or "column".
std::optional<std::string> describe_excess(const IndexRange& range, uint32_t count,
                                           const std::string& unit) {
  if (range.last < count) return std::nullopt;
  return fmt::format("{0} {1}, but the grid has {2} {0}{3}", unit, range.last, count,
                     count == 1 ? " (number 0)" : fmt::format("s (0 to {})", count - 1));
}

}  // namespace

bool is_picture_name(const fs::path& file) {
  constexpr std::array<std::string_view, 11> kExtensions = {
      ".png", ".ppm", ".pgm", ".pnm", ".jpg", ".jpeg", ".jpe", ".jfif", ".tif", ".tiff", ".webp"};
  return !file.filename().string().starts_with('.') &&
         std::ranges::find(kExtensions, lower_case_extension(file)) != kExtensions.end();
}

bool is_other_video(const fs::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions = {".mp4", ".m4v", ".mov",
                                                           ".mkv", ".avi", ".webm"};
  return std::ranges::find(kExtensions, lower_case_extension(file)) != kExtensions.end();
}

IoResult<ViewList> list_views(const fs::path& folder, const ViewNaming& naming) {
  const auto side_is_good = [](uint32_t side) { return side >= 1 && side <= kMaxGridSide; };
  if (naming.grid && !(side_is_good(naming.grid->rows) && side_is_good(naming.grid->cols))) {
    return file_error(folder, "a grid must have 1 to 4096 rows and 1 to 4096 columns");
  }
  std::error_code failure;
  if (!fs::is_directory(folder, failure) && is_other_video(folder)) {
    return file_error(folder, "a video, but not Y4M: ffmpeg -i VIDEO OUT.y4m makes one to read");
  }
  if (!fs::is_directory(folder, failure)) {
    return file_error(folder, "not a folder; give the folder that holds the views");
  }
  auto list = views_of(folder, naming);
  if (list) return list;
  list.error().message += other_files(folder) + elsewhere(folder, naming);
  return list;
}

IoResult<ViewList> part_of(const std::filesystem::path& folder, const ViewList& views,
                           const ViewPart& part) {
  auto excess = describe_excess(part.rows, views.rows, "row");
  if (!excess) excess = describe_excess(part.cols, views.cols, "column");
  if (excess) return file_error(folder, "--views asks for " + *excess);

  ViewList result{length(part.rows), length(part.cols), {}, views.folder};
  result.whole = views.files.size();
  for (uint32_t i = 0; i < result.rows; ++i) {
    const size_t row = part.rows.first + size_t{i} * part.rows.step;
    for (uint32_t j = 0; j < result.cols; ++j) {
      const size_t col = part.cols.first + size_t{j} * part.cols.step;
      result.numbers.push_back(row * views.cols + col);
      result.files.push_back(views.files[result.numbers.back()]);
    }
  }
  return result;
}

}  // namespace hmlfc::io
