// The rays, taps and sums of a row of a frame. The kernels are the renderer's inner loops, compiled
// once for each instruction set and chosen at run time; each equals the golden functions on every
// pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>

#include "render/taps.hpp"

namespace hmlfc {

/// The rays of a row, pixel by pixel; where a pixel is outside, u is kOutside and the others have
/// no meaning. Equal to trace() on each.
struct RowRays {
  static constexpr int32_t kOutside = -1;

  /// Room for `pixels` pixels and those that vectors write after them.
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

/// One axis of a run: for each view of the axis and each pixel of the row its taps (SMP-2) and its
/// weight (SMP-1). Only the run's pixels are set.
struct AxisRun {
  explicit AxisRun(size_t row_pixels) : row_pixels_(row_pixels) {}

  int32_t first_view = 0;
  int32_t views = 0;  ///< [1, kMaxAxisViews]

  /// Of view first_view + k: the first tap of each pixel, the fraction of the second, the weight.
  std::vector<int32_t> first[kMaxAxisViews];
  std::vector<int32_t> fraction[kMaxAxisViews];
  std::vector<int32_t> weight[kMaxAxisViews];

  /// Allocates the arrays of `count` views.
  void reserve(int32_t count) {
    for (int32_t k = 0; k < count; ++k) {
      if (!first[k].empty()) continue;
      for (auto* array : {&first[k], &fraction[k], &weight[k]}) array->resize(row_pixels_);
    }
  }

 private:
  size_t row_pixels_;
};

/// Both axes of a run.
struct RunTaps {
  explicit RunTaps(size_t row_pixels) : cols(row_pixels), rows(row_pixels) {}

  AxisRun cols;
  AxisRun rows;
};

/// The rays of row `j`: trace() of each pixel.
void trace_row(const FrameRecord& record, int32_t j, RowRays& rays);

/// The taps of `run` in all its views: axis_taps() of each pixel.
void find_taps(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps);

/// The weights of the views of `run`, whose taps are found: GridWeights of each pixel.
void find_weights(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps);

/// The number of pixels of views that the run's pixels read.
uint64_t count_reads(const RayRun& run, const RunTaps& taps);

/// Finds where along a run the blocks of 2^log2 pixels change that the taps `first` and `fraction`
/// (AxisRun) of one column, or row, of views read: writes these pixels to `steps`, always with the
/// run's first, and returns their number. `steps` has room for the run and one more.
int32_t find_steps(const int32_t* first, const int32_t* fraction, const RayRun& run, unsigned log2,
                   int32_t* steps);

/// The pixels of a view in memory (ViewPage).
struct ViewPixels {
  const uint8_t* const* rows = nullptr;
  bool two_bytes = false;  ///< a sample
};

/// Adds weight * q (SMP-3) of one view to the sums of the run's pixels: four sums a pixel, the
/// fourth without meaning. The view is column taps.cols.first_view + col, row likewise;
/// `interpolated` as SMP-2 has it for filter quadrilinear.
void add_view(const ViewPixels& pixels, const RayRun& run, const RunTaps& taps, bool interpolated,
              int32_t col, int32_t row, uint32_t* sums);

/// Converts the sums of a row's pixels to its samples of R, G, B (SMP-3).
void round_row(const uint32_t* sums, int32_t pixels, uint16_t* out);

/// The name of the instruction set chosen, such as "AVX2".
const char* render_instruction_set();

}  // namespace hmlfc
