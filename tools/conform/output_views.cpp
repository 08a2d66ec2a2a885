#include "conform/output_views.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/files.hpp"
#include "io/image_files.hpp"
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
  auto image = io::read_image(path, limits);
  if (!image) return image;
  if (image->width == shape.width && image->height == shape.height && image->depth == shape.depth) {
    return image;
  }
  return io::file_error(
      path, fmt::format("is a picture of {} x {} pixels of {} bits instead of {} x {} of {}",
                        image->width, image->height, image->depth, shape.width, shape.height,
                        shape.depth));
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
  const LightFieldShape shape{1, 1, width, height, depth};
  std::error_code ignored;
  const auto is_there = [&](const char* name) {
    return std::filesystem::exists(folder / name, ignored);
  };
  if (is_there("frame.raw")) {
    return read_raw(folder / "frame.raw", shape).map([](auto&& images) {
      return std::move(images.front());
    });
  }
  return read_picture(folder / (is_there("frame.ppm") ? "frame.ppm" : "frame.png"), shape);
}

}  // namespace hmlfc::conform
