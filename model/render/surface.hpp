// Where the rays of a frame with geometry meet surfaces (docs/rendering.md, section 9), in
// integers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include <hmlfc/camera.hpp>
#include <hmlfc/disparity.hpp>
#include <hmlfc/format.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "render/ray.hpp"

namespace hmlfc {

/// A cell holds 2^kCellLog2 pixels each way (SRF-1).
inline constexpr int kCellLog2 = 2;

/// a or b of the ray of cell `cell` in a frame of `pixels` pixels along this axis (SRF-1).
///
/// Example: of 5 pixels, at a = -4, -2, 0, 2 and 4, the cells' are at -1 and 4.
constexpr int32_t ray_of_cell(int32_t cell, int32_t pixels) {
  const int32_t middle = 8 * cell + 4 - pixels;
  return middle < pixels - 1 ? middle : pixels - 1;
}

/// Steps of a view's proposal (SRF-3).
inline constexpr int kDisplacementSteps = 2;

/// Whether the frame of `record` with `stop_level` has geometry.
constexpr bool has_geometry(const FrameRecord& record, int stop_level) {
  return record.geometry != 0 && stop_level == 0;
}

/// Cells that hold `pixels` pixels, [1, 1024].
constexpr int32_t cells_along(int32_t pixels) {
  return (pixels + (1 << kCellLog2) - 1) >> kCellLog2;
}

/// Stands for a block without a disparity, where disparities are plain integers.
inline constexpr int32_t kNoDisparity = INT32_MIN;

/// The displacement that a block of disparity `told` tells (SRF-3): [-2^15, 2^15 - 1].
constexpr int32_t displacement_of(const BlockDisparity& told, const FrameRecord& f) {
  if (told.confidence == 0) return 0;
  const int32_t d = told.disparity;
  const int32_t difference = (d < 0 ? -d : d) < f.fine ? -f.focus : d - f.focus;
  watch("focus, D - focus", f.focus);
  watch("focus, D - focus", difference);
  const int32_t e = clamp(difference, -(1 << 15), (1 << 15) - 1);
  watch("E", e);
  return e;
}

/// G of SRF-2: displacement `e` a row; `pitch` in [-2032, 2032].
constexpr int32_t displacement_a_row(int32_t e, int32_t pitch) {
  const int32_t g = floor_shift(e * pitch + (1 << 7), 8);
  watch("G", g);
  return g;
}

/// How far displacement `e`, or G, moves a ray at place `us`, Us or Vs, in view `view`, in units of
/// 2^-12 pixels (SRF-2).
///
/// Example: 512, 2 pixels a column, seen half a column to the right of the ray: 4096, a pixel.
constexpr int32_t displacement_in_view(int32_t e, int32_t view, int32_t us) {
  const int32_t steps = view * (1 << 12) - floor_shift(us, 4);
  watch("c * 2^12 - (Us >> 4)", steps);
  const int32_t product = e * steps;
  watch("E * (c * 2^12 - (Us >> 4))", product);
  return floor_shift(product, 8);
}

/// x(c, E) of SRF-2, with E = `e`; x(c) where that is 0, as in frames without geometry, in which
/// views of any distance have weight.
constexpr int32_t x_in_view(const FrameRecord& f, const Ray& ray, int32_t e, int32_t col) {
  if (e == 0) return x_in_view(f, ray.xb, col);
  const int32_t x = x_in_view(f, ray.xb, col) + displacement_in_view(e, col, ray.us);
  watch("x(c, E), y(r, E)", x);
  return x;
}

/// y(r, E) of SRF-2, with G = `g`, likewise.
constexpr int32_t y_in_view(const FrameRecord& f, const Ray& ray, int32_t g, int32_t row) {
  if (g == 0) return y_in_view(f, ray.yb, row);
  const int32_t y = y_in_view(f, ray.yb, row) + displacement_in_view(g, row, ray.vs);
  watch("x(c, E), y(r, E)", y);
  return y;
}

/// The displacements that the views with weight propose to a cell (SRF-3).
class Proposals {
 public:
  static constexpr size_t kMost = 4;         ///< proposals
  static constexpr int32_t kHalf = 32768;    ///< of the weight, which the median has
  static constexpr int32_t kEnough = 40960;  ///< of the weight, which has to agree
  static constexpr int32_t kAgreeing = 8 * kDisparityUnits;  ///< largest distance from the median

  /// `weight` in [1, 65536]; at most kMost proposals, whose weights sum to 65536.
  constexpr void add(int32_t displacement, int32_t weight) {
    given_[count_++] = {displacement, weight};
  }

  /// The median, or 0 where the views disagree.
  constexpr int32_t chosen() const {
    const int32_t median = this->median();
    int32_t agreeing = 0;
    for (size_t i = 0; i < count_; ++i) {
      const int32_t apart = given_[i].displacement - median;
      if ((apart < 0 ? -apart : apart) <= kAgreeing) agreeing += given_[i].weight;
    }
    return agreeing >= kEnough ? median : 0;
  }

  /// The least proposal such that those up to it have half of the weight.
  constexpr int32_t median() const {
    int32_t least = given_[0].displacement;
    for (size_t i = 0; i < count_; ++i) least = std::max(least, given_[i].displacement);
    for (size_t i = 0; i < count_; ++i) {
      const int32_t at = given_[i].displacement;
      int32_t weight = 0;
      for (size_t k = 0; k < count_; ++k) {
        if (given_[k].displacement <= at) weight += given_[k].weight;
      }
      if (weight >= kHalf) least = std::min(least, at);
    }
    return least;
  }

 private:
  struct Proposal {
    int32_t displacement = 0;
    int32_t weight = 0;
  };

  std::array<Proposal, kMost> given_{};
  size_t count_ = 0;
};

}  // namespace hmlfc
