#include "conform/output_views.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/files.hpp"
#include "io/image_files.hpp"
#include "io/json_text.hpp"
#include "io/view_list.hpp"

namespace hmlfc::conform {
namespace {

constexpr uint64_t kLeastLimit = uint64_t{3} << 20;  // samples of a picture

size_t sample_bytes(int depth) { return depth > 8 ? 2 : 1; }

io::IoResult<std::vector<RgbImage>> read_raw(const std::filesystem::path& path,
                                             const LightFieldShape& shape) {
  const auto file = io::map_file(path);
  if (!file) return tl::unexpected(file.error());
  const size_t count = size_t{shape.width} * shape.height * 3;
  const size_t views = size_t{shape.rows} * shape.cols;
  const auto bytes = file->bytes();
  const uint64_t expected = uint64_t{views} * count * sample_bytes(shape.depth);
  if (bytes.size() != expected) {
    return io::file_error(path, fmt::format("has {} bytes instead of {}", bytes.size(), expected));
  }
  std::vector<RgbImage> images(views, RgbImage{shape.width, shape.height, shape.depth, {}});
  const uint8_t* at = bytes.data();
  for (RgbImage& image : images) {
    image.samples.resize(count);
    for (uint16_t& sample : image.samples) {
      sample = *at++;
      if (shape.depth > 8) sample = static_cast<uint16_t>(sample | *at++ << 8);
      if (sample >> shape.depth != 0) {
        return io::file_error(path, fmt::format("the sample that ends at byte {} is {}, more than "
                                                "{} bits",
                                                at - bytes.data(), sample, shape.depth));
      }
    }
  }
  return images;
}

io::IoResult<RgbImage> read_picture(const std::filesystem::path& path,
                                    const LightFieldShape& shape) {
  // A picture of another size is to be named, not to take much memory.
  const uint64_t samples = uint64_t{shape.width} * shape.height * 3;
  const io::ImageLimits limits{std::max(4 * samples, kLeastLimit)};
  io::Notes notes;
  auto image = io::read_image(path, limits, &notes);
  if (!image) return image;
  for (const std::string& line : notes.lines()) {
    if (line.ends_with(io::kSurplusNote)) {
      return io::file_error(path, "goes on after the end of the picture");
    }
  }
  if (image->width == shape.width && image->height == shape.height && image->depth == shape.depth) {
    return image;
  }
  return io::file_error(
      path, fmt::format("is a picture of {} x {} pixels of {} bits instead of {} x {} of {}",
                        image->width, image->height, image->depth, shape.width, shape.height,
                        shape.depth));
}

// The only file in the folder with one of these names, whose content is `what`.
io::IoResult<std::filesystem::path> only_output(const std::filesystem::path& folder,
                                                std::span<const std::string_view> names,
                                                const std::string& what) {
  std::string other;
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    std::string name = entry.path().filename().string();
    if (std::ranges::count(names, name) != 0) found.push_back(name);
    other = std::move(name);
  }
  if (found.size() == 1) return folder / found.front();
  std::ranges::sort(found);
  if (!found.empty()) {
    return io::file_error(folder, fmt::format("has {}: one is enough", fmt::join(found, " and ")));
  }
  return io::file_error(folder,
                        fmt::format("{} instead of {}, {}",
                                    other.empty() ? "is empty" : "has " + io::shown_json(other),
                                    fmt::join(names, " or "), what));
}

}  // namespace

io::IoResult<std::vector<RgbImage>> read_output_views(const std::filesystem::path& folder,
                                                      const LightFieldShape& shape) {
  const auto raw = folder / kRawViewsName;
  std::error_code ignored;
  if (std::filesystem::exists(raw, ignored)) return read_raw(raw, shape);
  const auto list = io::list_views(folder);
  if (!list) return tl::unexpected(list.error());
  if (!list->notes.empty()) return tl::unexpected(io::IoError{list->notes.front()});
  if (list->rows != shape.rows || list->cols != shape.cols) {
    return io::file_error(folder, fmt::format("has {} x {} views instead of {} x {}", list->rows,
                                              list->cols, shape.rows, shape.cols));
  }
  std::vector<RgbImage> images;
  for (const auto& path : list->files) {
    auto image = read_picture(path, shape);
    if (!image) return tl::unexpected(image.error());
    images.push_back(std::move(*image));
  }
  return images;
}

io::IoResult<RgbImage> read_output_frame(const std::filesystem::path& folder, uint32_t width,
                                         uint32_t height, int depth) {
  constexpr std::string_view kNames[] = {"frame.raw", "frame.png", "frame.ppm"};
  const auto file =
      only_output(folder, kNames, fmt::format("{} x {} pixels of {} bits", width, height, depth));
  if (!file) return tl::unexpected(file.error());
  const LightFieldShape shape{1, 1, width, height, depth};
  if (file->extension() != ".raw") return read_picture(*file, shape);
  return read_raw(*file, shape).map([](auto&& images) { return std::move(images.front()); });
}

io::IoResult<std::vector<BlockDisparity>> read_output_map(const std::filesystem::path& folder,
                                                          size_t blocks) {
  constexpr std::string_view kNames[] = {"map.raw"};
  const std::string size = fmt::format("{} bytes, 3 for each of {} blocks", 3 * blocks, blocks);
  const auto file = only_output(folder, kNames, size).and_then(io::map_file);
  if (!file) return tl::unexpected(file.error());
  auto rest = file->bytes();
  if (rest.size() != 3 * blocks) {
    return io::file_error(folder / kNames[0],
                          fmt::format("has {} bytes instead of {}", rest.size(), size));
  }
  std::vector<BlockDisparity> map;
  for (; !rest.empty(); rest = rest.subspan(3)) {
    map.push_back({static_cast<int16_t>(rest[0] | rest[1] << 8), rest[2]});
  }
  return map;
}

}  // namespace hmlfc::conform
