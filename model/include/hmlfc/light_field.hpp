// A light field in memory: rows x cols views of one size, stored as compactly as its samples allow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/export.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc {

/// Shape of a light field.
struct LightFieldShape {
  uint32_t rows = 0;    ///< view rows, [1, 4096]
  uint32_t cols = 0;    ///< view columns, [1, 4096]
  uint32_t width = 0;   ///< pixels, [1, 65536]
  uint32_t height = 0;  ///< pixels, [1, 65536]
  int depth = 8;        ///< bits a sample, [8, 12]

  friend bool operator==(const LightFieldShape&, const LightFieldShape&) = default;
};

/// RGB views on a grid. Samples take one byte each at depth 8 and two above, so a light field of
/// depth 8 costs exactly rows * cols * width * height * 3 bytes.
///
/// Threads may write different views at the same time, not the same one.
class HMLFC_EXPORT LightField {
 public:
  LightField() = default;

  /// All samples 0. The shape's fields must lie in their intervals; the caller checks that the size
  /// fits in memory (throws std::bad_alloc otherwise).
  explicit LightField(const LightFieldShape& shape);

  /// As constructed; all sizes are 0 by default.
  const LightFieldShape& shape() const { return shape_; }

  /// Bytes of one row of one view: width * 3 * (1 or 2).
  size_t row_bytes() const { return static_cast<size_t>(shape_.width) * 3 * sample_bytes(); }

  /// Copies pixel row `y` in [0, height - 1] of view (row, col) to `out`: width * 3 samples R, G,
  /// B.
  void read_row(uint32_t row, uint32_t col, uint32_t y, std::span<uint16_t> out) const;

  /// Replaces pixel row `y` of view (row, col) by `in`: width * 3 samples in [0, 2^depth - 1].
  void write_row(uint32_t row, uint32_t col, uint32_t y, std::span<const uint16_t> in);

  /// Replaces view (row, col); `image` has this light field's width, height and depth.
  void set_view(uint32_t row, uint32_t col, const RgbImage& image);

  /// A copy of view (row, col).
  RgbImage view(uint32_t row, uint32_t col) const;

 private:
  size_t sample_bytes() const { return shape_.depth > 8 ? 2 : 1; }
  size_t row_offset(uint32_t row, uint32_t col, uint32_t y) const;

  LightFieldShape shape_;
  std::vector<uint8_t> bytes_;
};

}  // namespace hmlfc
