// Which pixels of which views make a pixel of a frame, and their weights (SMP-1 to SMP-3).
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>
#include <hmlfc/format.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "render/ray.hpp"
#include "render/surface.hpp"

namespace hmlfc {

/// Largest number of columns, or rows, of views with a weight: 2^(kMaxAperture + 1).
inline constexpr int kMaxAxisViews = 2 << kMaxAperture;

/// The views on one axis around a ray.
struct AxisWeights {
  int32_t first = 0;    ///< of the views with weights, which may lie outside the grid
  int32_t count = 0;    ///< [1, kMaxAxisViews]
  int32_t place = 0;    ///< A of SMP-1
  int32_t support = 0;  ///< S * 2^k: where the weight falls to 0
  int32_t log2 = 8;     ///< k

  /// The weight of view first + i, i in [0, count - 1]: [1, 256].
  constexpr int32_t weight(int32_t i) const {
    const int32_t distance = ((first + i) << log2) - place;
    const int32_t weight = support - (distance < 0 ? -distance : distance);
    watch("wr, wc", weight);
    return weight;
  }
};

/// The weights on one axis at `place`, U or V of RAY-3, for filters other than nearest. Every view
/// counted has a weight above 0; they sum to 256.
///
/// Example: place 2.25 steps, aperture 0: views 2 and 3 with weights 192 and 64.
constexpr AxisWeights axis_weights(int32_t place, int aperture) {
  AxisWeights axis;
  const int32_t steps = 1 << aperture;
  axis.log2 = 8 - 2 * aperture;
  axis.place = (place + (1 << (15 - axis.log2))) >> (16 - axis.log2);
  axis.support = steps << axis.log2;
  const int32_t below = axis.place >> axis.log2;
  const bool between = (axis.place & ((1 << axis.log2) - 1)) != 0;
  axis.first = below - steps + 1;
  axis.count = 2 * steps - (between ? 0 : 1);
  return axis;
}

/// The weights of filter nearest: one view with all of 256.
constexpr AxisWeights nearest_weights(int32_t place) {
  return {nearest_view(place), 1, nearest_view(place) << 8, 256, 8};
}

/// The weights on one axis for `filter`.
constexpr AxisWeights axis_weights(const FrameRecord& record, int32_t place) {
  return record.filter == static_cast<int32_t>(Filter::kNearest)
             ? nearest_weights(place)
             : axis_weights(place, record.aperture);
}

/// The weights of the views of one axis of the grid: those of views outside it count for the view
/// at its border (SMP-1).
class GridWeights {
 public:
  constexpr GridWeights(const AxisWeights& axis, int32_t views) : axis_(axis), last_(views - 1) {}

  /// The first and the last view with a weight; all between have one.
  constexpr int32_t first() const { return clamp(axis_.first, 0, last_); }
  constexpr int32_t last() const { return clamp(axis_.first + axis_.count - 1, 0, last_); }

  /// The weight of `view` in [first(), last()]: [1, 256].
  constexpr int32_t weight(int32_t view) const {
    int32_t sum = 0;
    for (int32_t i = 0; i < axis_.count; ++i) {
      if (clamp(axis_.first + i, 0, last_) == view) sum += axis_.weight(i);
    }
    return sum;
  }

 private:
  AxisWeights axis_;
  int32_t last_;
};

/// One axis of a pixel's taps in a view.
struct AxisTaps {
  int32_t first = 0;     ///< xi or yi
  int32_t fraction = 0;  ///< weight of pixel first + 1, [0, 255] of 256; pixel first has the rest

  /// The last pixel that is read.
  constexpr int32_t last() const { return first + (fraction == 0 ? 0 : 1); }
};

/// The pixel nearest to coordinate `x` in a picture of `size` pixels along this axis (SMP-2).
constexpr int32_t nearest_pixel(int32_t x, int32_t size) {
  const int32_t inside = clamp(x, 0, (size - 1) << 12);
  watch("x, y after their clamp", inside);
  return (inside + kHalfPixel) >> 12;
}

/// The taps at coordinate `x`, x(c) or y(r) of RAY-4, in a picture of `size` pixels along this
/// axis.
///
/// Example: x = 3.5 pixels: pixels 3 and 4, fraction 128; at filters without interpolation of
/// pixels pixel 4.
constexpr AxisTaps axis_taps(const FrameRecord& record, int32_t x, int32_t size) {
  if (record.filter != static_cast<int32_t>(Filter::kQuadrilinear)) {
    return {nearest_pixel(x, size), 0};
  }
  const int32_t inside = clamp(x, 0, (size - 1) << 12);
  watch("x, y after their clamp", inside);
  const int32_t rounded = (inside + 8) >> 4;
  return {rounded >> 8, rounded & 255};
}

/// q of SMP-2 for the samples of four pixels in [0, 2^depth - 1], depth in [8, 12]; those of weight
/// 0 have no effect.
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

/// One view's part in a pixel of a frame.
struct ViewTaps {
  ViewPos view;
  uint32_t weight = 0;  ///< [1, 65536]
  AxisTaps x;
  AxisTaps y;
};

/// Calls visit(const ViewTaps&) for each view with a weight in the pixel of `ray`, whose cell has
/// displacement `e` (SRF-4; 0 without geometry), each view once.
template <class Visit>
void for_each_view_taps(const FrameRecord& record, const Ray& ray, int32_t e, const Visit& visit) {
  const int32_t g = displacement_a_row(e, record.pitch);
  const GridWeights rows(axis_weights(record, ray.v), record.rows);
  const GridWeights cols(axis_weights(record, ray.u), record.cols);
  for (int32_t row = rows.first(); row <= rows.last(); ++row) {
    const AxisTaps y = axis_taps(record, y_in_view(record, ray, g, row), record.height);
    for (int32_t col = cols.first(); col <= cols.last(); ++col) {
      const AxisTaps x = axis_taps(record, x_in_view(record, ray, e, col), record.width);
      const auto weight = static_cast<uint32_t>(rows.weight(row) * cols.weight(col));
      watch("weight of a view", weight);
      visit(ViewTaps{{static_cast<uint32_t>(row), static_cast<uint32_t>(col)}, weight, x, y});
    }
  }
}

}  // namespace hmlfc
