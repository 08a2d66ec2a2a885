#include "io/pictures.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace hmlfc::io {
namespace {

constexpr uint32_t kGap = 2;

uint32_t ceil_div(uint32_t a, uint32_t b) { return a / b + (a % b != 0 ? 1 : 0); }

uint64_t sheet_side(uint32_t views, uint32_t cell) {
  return uint64_t{views} * cell + uint64_t{views - 1} * kGap;
}

/// The smallest factor at which the sheet fits.
uint32_t choose_factor(const LightFieldShape& shape, uint32_t max_width) {
  const uint32_t greatest = std::max(shape.width, shape.height);
  uint32_t factor = 1;
  while (factor < greatest && sheet_side(shape.cols, ceil_div(shape.width, factor)) > max_width) {
    ++factor;
  }
  return factor;
}

/// Rounded means of the boxes of one row of cells: `sums` of the samples over the box's `lines`
/// pixel rows, for every pixel column.
void reduce_line(const std::vector<uint64_t>& sums, uint32_t width, uint32_t factor, uint32_t lines,
                 uint16_t* out) {
  for (uint32_t x = 0; x < width; x += factor) {
    const uint32_t end = std::min(width, x + factor);
    const uint64_t count = uint64_t{end - x} * lines;
    for (uint32_t channel = 0; channel < 3; ++channel) {
      uint64_t sum = 0;
      for (uint32_t i = x; i < end; ++i) sum += sums[size_t{i} * 3 + channel];
      *out++ = static_cast<uint16_t>((sum + count / 2) / count);
    }
  }
}

}  // namespace

IoResult<ContactSheet> ContactSheet::make(const LightFieldShape& shape, uint32_t max_width) {
  constexpr uint64_t kMostPixels = uint64_t{1} << 26;
  const uint32_t factor = choose_factor(shape, max_width);
  const uint64_t width = sheet_side(shape.cols, ceil_div(shape.width, factor));
  const uint64_t height = sheet_side(shape.rows, ceil_div(shape.height, factor));
  if (width > kMostPixels / height) {
    return tl::unexpected(IoError{
        fmt::format("a sheet of {} x {} pixels is too large; choose a smaller width or fewer views",
                    width, height)});
  }
  return ContactSheet(shape, factor);
}

ContactSheet::ContactSheet(const LightFieldShape& shape, uint32_t factor)
    : factor_(factor),
      cell_width_(ceil_div(shape.width, factor)),
      cell_height_(ceil_div(shape.height, factor)) {
  sheet_.width = static_cast<uint32_t>(sheet_side(shape.cols, cell_width_));
  sheet_.height = static_cast<uint32_t>(sheet_side(shape.rows, cell_height_));
  sheet_.depth = shape.depth;
  const auto dark = static_cast<uint16_t>(24 << (shape.depth - 8));
  sheet_.samples.assign(size_t{sheet_.width} * sheet_.height * 3, dark);
}

void ContactSheet::draw(uint32_t row, uint32_t col, const RgbImage& view) {
  const size_t left = size_t{col} * (cell_width_ + kGap);
  const size_t top = size_t{row} * (cell_height_ + kGap);
  const size_t line = size_t{view.width} * 3;
  std::vector<uint64_t> sums(line);
  for (uint32_t y = 0; y < view.height; y += factor_) {
    std::ranges::fill(sums, 0);
    const uint32_t end = std::min(view.height, y + factor_);
    for (uint32_t i = y; i < end; ++i) {
      const auto samples = std::span(view.samples).subspan(i * line, line);
      std::ranges::transform(sums, samples, sums.begin(), std::plus<uint64_t>());
    }
    const size_t at = ((top + y / factor_) * sheet_.width + left) * 3;
    reduce_line(sums, view.width, factor_, end - y, sheet_.samples.data() + at);
  }
}

IoResult<RgbImage> difference_picture(const RgbImage& a, const RgbImage& b, int32_t gain) {
  if (a.width != b.width || a.height != b.height || a.depth != b.depth) {
    return tl::unexpected(
        IoError{"the two pictures differ in size or depth; give views of the "
                "same light field"});
  }
  RgbImage picture{a.width, a.height, 8, {}};
  picture.samples.reserve(a.samples.size());
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const int32_t scaled = gain * (int32_t{a.samples[i]} - int32_t{b.samples[i]});
    const int32_t value = 128 + (scaled >> (a.depth - 8));  // C++20: an arithmetic shift, the floor
    picture.samples.push_back(static_cast<uint16_t>(std::clamp(value, 0, 255)));
  }
  return picture;
}

}  // namespace hmlfc::io
