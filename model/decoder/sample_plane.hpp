// Samples in memory: planes, blocks, and rectangles of blocks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "syntax/geometry.hpp"

namespace hmlfc {
/// width x height samples, row-major. Samples of depth 12 and their residuals fit in 16 bits
/// (specification, section 11).
struct SamplePlane {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<int16_t> samples;

  SamplePlane() = default;
  SamplePlane(uint32_t w, uint32_t h) : width(w), height(h), samples(size_t{w} * h) {}

  std::span<int16_t> row(uint32_t y) { return {samples.data() + size_t{y} * width, width}; }
  std::span<const int16_t> row(uint32_t y) const {
    return {samples.data() + size_t{y} * width, width};
  }
  int16_t at(uint32_t x, uint32_t y) const { return samples[size_t{y} * width + x]; }
};

/// Copies columns x rows samples of `from`, from (x, y) on, to the top left of `to`.
inline void copy_samples(const SamplePlane& from, uint32_t x, uint32_t y, uint32_t columns,
                         uint32_t rows, SamplePlane& to) {
  for (uint32_t j = 0; j < rows; ++j) {
    std::ranges::copy(from.row(y + j).subspan(x, columns), to.row(j).begin());
  }
}

inline constexpr unsigned kMaxBlockSize = 8;

/// B x B values, row by row, B in {2, 4, 8}.
class BlockValues {
 public:
  explicit BlockValues(unsigned block_size) : block_size_(block_size) {}

  unsigned block_size() const { return block_size_; }
  size_t size() const { return size_t{block_size_} * block_size_; }

  int32_t& at(unsigned x, unsigned y) { return values_[y * block_size_ + x]; }
  int32_t at(unsigned x, unsigned y) const { return values_[y * block_size_ + x]; }
  int32_t& operator[](size_t i) { return values_[i]; }
  int32_t operator[](size_t i) const { return values_[i]; }

  std::span<const int32_t> span() const { return {values_.data(), size()}; }

 private:
  unsigned block_size_;
  std::array<int32_t, size_t{kMaxBlockSize} * kMaxBlockSize> values_{};
};

/// Blocks [bx0, bx1) x [by0, by1) of a plane, not empty.
struct BlockRect {
  uint32_t bx0 = 0;
  uint32_t by0 = 0;
  uint32_t bx1 = 0;
  uint32_t by1 = 0;
};

/// All blocks of a plane.
inline BlockRect whole_plane(const PlaneShape& plane) {
  return {0, 0, plane.blocks_x, plane.blocks_y};
}

/// Block (bx, by) of `plane` (DEC-2); positions outside the plane are 0.
inline BlockValues block_of_plane(const SamplePlane& plane, unsigned block_size, uint32_t bx,
                                  uint32_t by) {
  BlockValues values(block_size);
  for (unsigned j = 0; j < block_size; ++j) {
    for (unsigned i = 0; i < block_size; ++i) {
      const uint32_t x = bx * block_size + i;
      const uint32_t y = by * block_size + j;
      if (x < plane.width && y < plane.height) values.at(i, j) = plane.at(x, y);
    }
  }
  return values;
}

}  // namespace hmlfc
