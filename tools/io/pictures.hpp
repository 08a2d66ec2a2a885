// Images for people: all views at once, and the difference of two.
#pragma once

#include <cstdint>

#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// All views side by side in their order, each reduced by the smallest whole factor k >= 1 with
/// which the sheet is at most `max_width` pixels wide (k = the greater side if none is enough),
/// with two dark pixels between neighbours. A pixel is the mean of its k x k box, halves rounded
/// up; boxes at the right and bottom edges may be smaller. Depth as in the views. Integer
/// arithmetic only.
class ContactSheet {
 public:
  /// Dark everywhere. Errors: the sheet would have more than 2^26 pixels.
  static IoResult<ContactSheet> make(const LightFieldShape& shape, uint32_t max_width);

  /// Draws view (row, col), of the shape's size. Several threads may draw different views at once.
  void draw(uint32_t row, uint32_t col, const RgbImage& view);

  const RgbImage& image() const { return sheet_; }

 private:
  ContactSheet(const LightFieldShape& shape, uint32_t factor);

  uint32_t factor_;
  uint32_t cell_width_;
  uint32_t cell_height_;
  RgbImage sheet_;
};

/// 128 + gain * (a - b), clamped to [0, 255], per sample; depth 8. Deeper pictures are compared at
/// their own depth d: 128 + floor(gain * (a - b) / 2^(d - 8)). Grey 128 is "equal"; gain in
/// [1, 4096]. Errors: `a` and `b` differ in size or depth.
IoResult<RgbImage> difference_picture(const RgbImage& a, const RgbImage& b, int32_t gain);

}  // namespace hmlfc::io
