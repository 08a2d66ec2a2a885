#include <hmlfc/light_field.hpp>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace hmlfc {

LightField::LightField(const LightFieldShape& shape) : shape_(shape) {
  bytes_.resize(static_cast<size_t>(shape.rows) * shape.cols * shape.height * row_bytes());
}

size_t LightField::row_offset(uint32_t row, uint32_t col, uint32_t y) const {
  assert(row < shape_.rows && col < shape_.cols && y < shape_.height);
  const size_t view = static_cast<size_t>(row) * shape_.cols + col;
  return (view * shape_.height + y) * row_bytes();
}

void LightField::read_row(uint32_t row, uint32_t col, uint32_t y, std::span<uint16_t> out) const {
  const uint8_t* source = bytes_.data() + row_offset(row, col, y);
  assert(out.size() == static_cast<size_t>(shape_.width) * 3);
  if (sample_bytes() == 1) {
    std::copy_n(source, out.size(), out.begin());
  } else {
    std::memcpy(out.data(), source, row_bytes());
  }
}

void LightField::write_row(uint32_t row, uint32_t col, uint32_t y, std::span<const uint16_t> in) {
  uint8_t* target = bytes_.data() + row_offset(row, col, y);
  assert(in.size() == static_cast<size_t>(shape_.width) * 3);
  if (sample_bytes() == 1) {
    std::transform(in.begin(), in.end(), target,
                   [](uint16_t sample) { return static_cast<uint8_t>(sample); });
  } else {
    std::memcpy(target, in.data(), row_bytes());
  }
}

void LightField::set_view(uint32_t row, uint32_t col, const RgbImage& image) {
  assert(image.width == shape_.width && image.height == shape_.height);
  const size_t row_samples = static_cast<size_t>(shape_.width) * 3;
  for (uint32_t y = 0; y < shape_.height; ++y) {
    write_row(row, col, y, std::span(image.samples).subspan(y * row_samples, row_samples));
  }
}

RgbImage LightField::view(uint32_t row, uint32_t col) const {
  RgbImage image{shape_.width, shape_.height, shape_.depth, {}};
  const size_t row_samples = static_cast<size_t>(shape_.width) * 3;
  image.samples.resize(row_samples * shape_.height);
  for (uint32_t y = 0; y < shape_.height; ++y) {
    read_row(row, col, y, std::span(image.samples).subspan(y * row_samples, row_samples));
  }
  return image;
}

}  // namespace hmlfc
