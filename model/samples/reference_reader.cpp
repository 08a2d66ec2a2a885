#include "samples/reference_reader.hpp"

#include <algorithm>

#include "values/rounding.hpp"

namespace hmlfc {
namespace {

uint32_t inside(int32_t coordinate, uint32_t size) {
  return static_cast<uint32_t>(clamp(coordinate, 0, static_cast<int32_t>(size) - 1));
}

}  // namespace

Result<ReferenceReader> ReferenceReader::open(const DecodeSources& sources, int level,
                                              ImagePos image, Plane plane) {
  const Geometry& geometry = sources.stream.geometry;
  ReferenceReader reader(geometry.plane(plane), geometry.block_size());
  const ImagePos reference = geometry.reference_of(level, image);
  if (level == geometry.top()) {
    auto key = sources.keys.plane(reference, plane);
    if (!key) return tl::unexpected(key.error());
    reader.key_ = *key;
  } else {
    auto sparse = sources.references->plane(level, reference, plane);
    if (!sparse) return tl::unexpected(sparse.error());
    reader.sparse_ = *sparse;
  }
  return reader;
}

Result<void> ReferenceReader::read(int32_t x, int32_t y, int16_t* out) const {
  if (!is_inside(x, y)) return read_clamped(x, y, out);
  if (!key_) return read_sparse(static_cast<uint32_t>(x), static_cast<uint32_t>(y), out);
  read_key(static_cast<uint32_t>(x), static_cast<uint32_t>(y), out);
  return {};
}

bool ReferenceReader::is_inside(int32_t x, int32_t y) const {
  const auto size = static_cast<int32_t>(block_size_);
  return x >= 0 && y >= 0 && x + size <= static_cast<int32_t>(plane_.width) &&
         y + size <= static_cast<int32_t>(plane_.height);
}

Result<void> ReferenceReader::read_clamped(int32_t x, int32_t y, int16_t* out) const {
  const auto size = static_cast<int32_t>(block_size_);
  for (int32_t j = 0; j < size; ++j) {
    const uint32_t row = inside(y + j, plane_.height);
    for (int32_t i = 0; i < size; ++i) {
      const auto value = sample(inside(x + i, plane_.width), row);
      if (!value) return tl::unexpected(value.error());
      *out++ = *value;
    }
  }
  return {};
}

void ReferenceReader::read_key(uint32_t x, uint32_t y, int16_t* out) const {
  for (unsigned j = 0; j < block_size_; ++j) {
    out = std::copy_n(key_->samples.data() + size_t{y + j} * plane_.width + x, block_size_, out);
  }
}

// Copies the parts of up to 2 x 2 blocks, or zeros.
Result<void> ReferenceReader::read_sparse(uint32_t x, uint32_t y, int16_t* out) const {
  const unsigned size = block_size_;
  uint32_t rows = 0;
  for (uint32_t row = 0; row < size; row += rows) {
    const uint32_t in_y = (y + row) % size;
    rows = std::min(size - row, size - in_y);
    uint32_t cols = 0;
    for (uint32_t col = 0; col < size; col += cols) {
      const uint32_t in_x = (x + col) % size;
      cols = std::min(size - col, size - in_x);
      const auto block = sparse_->find((x + col) / size, (y + row) / size);
      if (!block) return tl::unexpected(block.error());
      for (uint32_t j = 0; j < rows; ++j) {
        int16_t* target = out + size_t{row + j} * size + col;
        if (*block == nullptr) {
          std::fill_n(target, cols, int16_t{0});
        } else {
          std::copy_n(*block + size_t{in_y + j} * size + in_x, cols, target);
        }
      }
    }
  }
  return {};
}

Result<int16_t> ReferenceReader::sample(uint32_t x, uint32_t y) const {
  if (key_) return key_->at(x, y);
  const auto block = sparse_->find(x / block_size_, y / block_size_);
  if (!block) return tl::unexpected(block.error());
  if (*block == nullptr) return int16_t{0};
  return (*block)[(y % block_size_) * block_size_ + x % block_size_];
}

}  // namespace hmlfc
