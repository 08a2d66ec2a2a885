#include "io/view_mosaic.hpp"

#include <algorithm>
#include <regex>
#include <string>

#include "io/files.hpp"
#include "io/image_files.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

constexpr uint32_t kMaxPictureSide = 65536;

// Pixel (x, y) of a view lies at (left + x * step_x, top + y * step_y).
struct Place {
  size_t left;
  size_t top;
  size_t step_x;
  size_t step_y;
};

// Of view (row, col) of width x height in `picture`; what a quilt has too much is on top.
Place place_of(const RgbImage& picture, const Mosaic& mosaic, uint32_t width, uint32_t height,
               uint32_t row, uint32_t col) {
  if (mosaic.layout == MosaicLayout::kLenslets) return {col, row, mosaic.cols, mosaic.rows};
  if (mosaic.layout == MosaicLayout::kTiles)
    return {size_t{col} * width, size_t{row} * height, 1, 1};
  const size_t rows_below = col / mosaic.cols + 1;
  return {size_t{col % mosaic.cols} * width, picture.height - rows_below * height, 1, 1};
}

// Calls body(index of the first sample in the picture, in the view) for each pixel of a view.
template <class Body>
void for_each_pixel(const RgbImage& picture, uint32_t width, uint32_t height, const Place& place,
                    const Body& body) {
  size_t in_view = 0;
  for (uint32_t y = 0; y < height; ++y) {
    size_t at = (place.top + y * place.step_y) * picture.width + place.left;
    for (uint32_t x = 0; x < width; ++x, at += place.step_x, in_view += 3) body(3 * at, in_view);
  }
}

std::string sides(uint64_t width, uint64_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

}  // namespace

GridShape Mosaic::grid() const {
  return layout == MosaicLayout::kQuilt ? GridShape{1, rows * cols} : GridShape{rows, cols};
}

std::optional<QuiltName> parse_quilt_name(const std::filesystem::path& file) {
  static const std::regex form(
      R"(_qs(\d{1,4})x(\d{1,4})(?:a(\d{1,5}(?:\.\d{0,16})?))?(?![^ _(-]))");
  const std::string stem = lower_case(file.stem().string());
  const size_t at = stem.rfind("_qs");
  std::smatch parts;
  if (at == stem.npos || !std::regex_search(stem.cbegin() + static_cast<ptrdiff_t>(at), stem.cend(),
                                            parts, form, std::regex_constants::match_continuous)) {
    return std::nullopt;
  }
  const auto number = [&](size_t part) { return static_cast<uint32_t>(std::stoul(parts[part])); };
  QuiltName quilt{{MosaicLayout::kQuilt, number(2), number(1)}, std::nullopt};
  const auto& [layout, rows, cols] = quilt.mosaic;
  if (parts[3].matched) quilt.aspect = std::stod(parts[3]);
  if (cols < 1 || rows < 1 || cols > kMaxGridSide || rows > kMaxGridSide / cols ||
      !(quilt.aspect.value_or(1) > 0 && quilt.aspect.value_or(1) < kMaxPictureSide)) {
    return std::nullopt;
  }
  return quilt;
}

IoResult<LightFieldShape> mosaic_shape(const std::filesystem::path& file, const RgbImage& picture,
                                       const Mosaic& mosaic) {
  const bool may_rest = mosaic.layout == MosaicLayout::kQuilt;
  const bool rests = picture.width % mosaic.cols != 0 || picture.height % mosaic.rows != 0;
  if ((rests && !may_rest) || picture.width < mosaic.cols || picture.height < mosaic.rows) {
    return file_error(file, sides(picture.width, picture.height) + " cannot be divided into " +
                                std::to_string(mosaic.cols) + " columns and " +
                                std::to_string(mosaic.rows) + " rows of views");
  }
  const GridShape grid = mosaic.grid();
  return LightFieldShape{grid.rows, grid.cols, picture.width / mosaic.cols,
                         picture.height / mosaic.rows, picture.depth};
}

RgbImage view_of_mosaic(const RgbImage& picture, const Mosaic& mosaic, uint32_t row, uint32_t col) {
  RgbImage view{picture.width / mosaic.cols, picture.height / mosaic.rows, picture.depth, {}};
  view.samples.resize(size_t{3} * view.width * view.height);
  const Place place = place_of(picture, mosaic, view.width, view.height, row, col);
  for_each_pixel(picture, view.width, view.height, place, [&](size_t from, size_t to) {
    std::copy_n(picture.samples.data() + from, 3, view.samples.data() + to);
  });
  return view;
}

IoResult<RgbImage> empty_mosaic(const std::filesystem::path& file, const LightFieldShape& shape,
                                const Mosaic& mosaic) {
  const uint64_t width = uint64_t{shape.width} * mosaic.cols;
  const uint64_t height = uint64_t{shape.height} * mosaic.rows;
  if (width > kMaxPictureSide || height > kMaxPictureSide ||
      3 * width * height > ImageLimits{}.max_samples) {
    return file_error(
        file, sides(width, height) + " are too many for one picture; write the views to a folder");
  }
  RgbImage picture{static_cast<uint32_t>(width), static_cast<uint32_t>(height), shape.depth, {}};
  picture.samples.resize(static_cast<size_t>(3 * width * height));
  return picture;
}

void put_into_mosaic(RgbImage& picture, const Mosaic& mosaic, uint32_t row, uint32_t col,
                     const RgbImage& view) {
  const Place place = place_of(picture, mosaic, view.width, view.height, row, col);
  for_each_pixel(picture, view.width, view.height, place, [&](size_t to, size_t from) {
    std::copy_n(view.samples.data() + from, 3, picture.samples.data() + to);
  });
}

}  // namespace hmlfc::io
