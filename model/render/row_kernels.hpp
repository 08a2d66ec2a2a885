// The renderer's inner loops over a row of a frame, compiled once for each instruction set and
// chosen at run time. Each is equal to the golden functions on every pixel.
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

#include "render/row_rays.hpp"
#include "render/row_taps.hpp"

namespace hmlfc {

/// The rays of row `j`: trace() of each pixel.
void trace_row(const FrameRecord& record, int32_t j, RowRays& rays);

/// The taps of `run` in all its views: axis_taps() of each pixel.
void find_taps(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps);

/// The weights of the views of `run`, whose taps are found: GridWeights of each pixel.
void find_weights(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps);

/// The pixels of views that the run's pixels read with a weight.
uint64_t count_reads(const RayRun& run, const RunTaps& taps);

/// Where along a run the blocks of 2^log2 pixels change that one column, or row, of views reads by
/// the taps `first` and `fraction` (AxisRun): writes these pixels to `steps`, the run's first
/// always, and returns how many. `steps` has room for the run and one more.
int32_t find_steps(const int32_t* first, const int32_t* fraction, const RayRun& run, unsigned log2,
                   int32_t* steps);

/// Pixels of a view in memory (see ViewPage).
struct ViewPixels {
  const uint8_t* const* rows = nullptr;
  bool two_bytes = false;  ///< a sample
};

/// Adds weight * q (SMP-3) of one view to the sums of the run's pixels: four sums a pixel, the
/// fourth without meaning. The view is column taps.cols.first_view + col, row likewise;
/// `interpolated` as SMP-2 has it for filter quadrilinear.
void add_view(const ViewPixels& pixels, const RayRun& run, const RunTaps& taps, bool interpolated,
              int32_t col, int32_t row, uint32_t* sums);

/// Turns the sums of a row's pixels to its samples of R, G, B (SMP-3).
void round_row(const uint32_t* sums, int32_t pixels, uint16_t* out);

/// The name of the instruction set chosen, such as "AVX2".
const char* render_instruction_set();

}  // namespace hmlfc
