// The rays of one row of a frame, and the runs of pixels that the same views make.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>

#include "render/view_weights.hpp"

namespace hmlfc {

/// The rays of a row, pixel by pixel; where a pixel is outside, u is kOutside and the others have
/// no meaning. Equal to trace() on each.
struct RowRays {
  static constexpr int32_t kOutside = -1;

  /// Room for `pixels` pixels and those that vectors write behind them.
  explicit RowRays(size_t pixels)
      : u(pixels + kSpare), v(pixels + kSpare), xb(pixels + kSpare), yb(pixels + kSpare) {}

  static constexpr size_t kSpare = 64;

  std::vector<int32_t> u;
  std::vector<int32_t> v;
  std::vector<int32_t> xb;
  std::vector<int32_t> yb;
};

/// Pixels [begin, end) of a row, all inside, with weights for the same views.
struct RayRun {
  int32_t begin = 0;
  int32_t end = 0;
  int32_t first_col = 0;  ///< views with a weight: [first_col, last_col] x [first_row, last_row]
  int32_t last_col = 0;
  int32_t first_row = 0;
  int32_t last_row = 0;
};

/// Calls visit(const RayRun&) for the runs of a row, from left to right.
template <class Visit>
void for_each_run(const FrameRecord& record, const RowRays& rays, const Visit& visit) {
  const auto run_at = [&](int32_t i) {
    const auto at = static_cast<size_t>(i);
    const GridWeights cols(axis_weights(record, rays.u[at]), record.cols);
    const GridWeights rows(axis_weights(record, rays.v[at]), record.rows);
    return RayRun{i, i, cols.first(), cols.last(), rows.first(), rows.last()};
  };
  const auto same_place = [&](int32_t i, int32_t j) {
    return rays.u[static_cast<size_t>(i)] == rays.u[static_cast<size_t>(j)] &&
           rays.v[static_cast<size_t>(i)] == rays.v[static_cast<size_t>(j)];
  };
  int32_t i = 0;
  while (i < record.frame_width) {
    if (rays.u[static_cast<size_t>(i)] == RowRays::kOutside) {
      ++i;
      continue;
    }
    RayRun run = run_at(i);
    for (++i; i < record.frame_width && rays.u[static_cast<size_t>(i)] != RowRays::kOutside; ++i) {
      if (same_place(i - 1, i)) continue;
      const RayRun next = run_at(i);
      if (next.first_col != run.first_col || next.last_col != run.last_col ||
          next.first_row != run.first_row || next.last_row != run.last_row) {
        break;
      }
    }
    run.end = i;
    visit(run);
  }
}

}  // namespace hmlfc
