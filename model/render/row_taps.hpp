// The taps of a run of pixels in the columns and rows of views that have weights.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>

#include "render/row_rays.hpp"
#include "render/view_weights.hpp"

namespace hmlfc {

/// One axis of a run: for each view of the axis and each pixel of the row its taps (SMP-2) and its
/// weight (SMP-1). Only the run's pixels have a meaning.
struct AxisRun {
  explicit AxisRun(size_t row_pixels);

  int32_t first_view = 0;
  int32_t views = 0;  ///< [1, kMaxAxisViews]

  /// Of view first_view + k: the first tap of each pixel, the fraction of the second, the weight.
  std::vector<int32_t> first[kMaxAxisViews];
  std::vector<int32_t> fraction[kMaxAxisViews];
  std::vector<int32_t> weight[kMaxAxisViews];

  /// Makes room for the arrays of `count` views.
  void reserve(int32_t count);

 private:
  size_t row_pixels_;
};

/// Both axes of a run.
struct RunTaps {
  explicit RunTaps(size_t row_pixels) : cols(row_pixels), rows(row_pixels) {}

  AxisRun cols;
  AxisRun rows;
};

}  // namespace hmlfc
