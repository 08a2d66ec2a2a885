// The pixels of views that a frame reads, ray by ray (SMP-1, SMP-2).
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

#include "arithmetic/widths.hpp"
#include "render/pixel_taps.hpp"
#include "render/ray.hpp"
#include "render/view_weights.hpp"

namespace hmlfc {

/// One view's part in a pixel of a frame.
struct ViewTaps {
  ViewPos view;
  uint32_t weight = 0;  ///< [1, 65536]
  AxisTaps x;
  AxisTaps y;
};

/// Calls visit(const ViewTaps&) for each view with a weight in the pixel of `ray`, each view once.
template <class Visit>
void for_each_view_taps(const FrameRecord& record, const Ray& ray, const Visit& visit) {
  const GridWeights rows(axis_weights(record, ray.v), record.rows);
  const GridWeights cols(axis_weights(record, ray.u), record.cols);
  for (int32_t row = rows.first(); row <= rows.last(); ++row) {
    const AxisTaps y = axis_taps(record, y_in_view(record, ray.yb, row), record.height);
    for (int32_t col = cols.first(); col <= cols.last(); ++col) {
      const AxisTaps x = axis_taps(record, x_in_view(record, ray.xb, col), record.width);
      const auto weight = static_cast<uint32_t>(rows.weight(row) * cols.weight(col));
      watch("weight of a view", weight);
      visit(ViewTaps{{static_cast<uint32_t>(row), static_cast<uint32_t>(col)}, weight, x, y});
    }
  }
}

}  // namespace hmlfc
