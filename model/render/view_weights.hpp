// Which views make a pixel of a frame, and their weights (SMP-1).
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "render/ray.hpp"

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

/// The weights on one axis at `place`, U or V of RAY-3, for filters but nearest. Every view counted
/// has a weight above 0; they are 256 in sum.
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

}  // namespace hmlfc
