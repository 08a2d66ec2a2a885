// Which pixels of a view make a pixel of a frame, and their weights (SMP-2).
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "render/ray.hpp"

namespace hmlfc {

/// One axis of a pixel's taps in a view.
struct AxisTaps {
  int32_t first = 0;     ///< xi or yi
  int32_t fraction = 0;  ///< weight of pixel first + 1, [0, 255] of 256; pixel first has the rest

  /// The last pixel that is read.
  constexpr int32_t last() const { return first + (fraction == 0 ? 0 : 1); }
};

/// The taps at coordinate `x`, x(c) or y(r) of RAY-4, in a picture of `size` pixels along this
/// axis.
///
/// Example: x = 3.5 pixels: pixels 3 and 4, fraction 128; at filters without interpolation of
/// pixels pixel 4.
constexpr AxisTaps axis_taps(const FrameRecord& record, int32_t x, int32_t size) {
  const int32_t inside = clamp(x, 0, (size - 1) << 12);
  watch("x, y after their clamp", inside);
  if (record.filter != static_cast<int32_t>(Filter::kQuadrilinear)) {
    return {(inside + kHalfPixel) >> 12, 0};
  }
  const int32_t rounded = (inside + 8) >> 4;
  return {rounded >> 8, rounded & 255};
}

/// q of SMP-2 for the samples of four pixels in [0, 2^depth - 1], depth in [8, 12]; those of weight
/// 0 do not matter.
constexpr int32_t interpolate_pixels(const AxisTaps& x, const AxisTaps& y, int32_t p00, int32_t p10,
                                     int32_t p01, int32_t p11, int depth) {
  const int32_t above = (256 - x.fraction) * p00 + x.fraction * p10;
  const int32_t below = (256 - x.fraction) * p01 + x.fraction * p11;
  const int32_t sum = (256 - y.fraction) * above + y.fraction * below + (1 << 11);
  watch("sum of four taps", sum, depth);
  const int32_t q = sum >> 12;
  watch("q", q, depth);
  return q;
}

/// A frame's sample from the sum of weight * q over all views (SMP-3): [0, 2^depth - 1].
constexpr int32_t frame_sample(uint32_t sum, int depth) {
  const uint32_t rounded = sum + (1u << 19);
  watch("sum over views", rounded, depth);
  return static_cast<int32_t>(rounded >> 20);
}

}  // namespace hmlfc
