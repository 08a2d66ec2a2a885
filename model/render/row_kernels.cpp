#include "render/row_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/row_kernels.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

#include "render/row_rays-inl.hpp"
#include "render/row_sums-inl.hpp"
#include "render/run_taps-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

const char* render_set_here() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(trace_row_here);
HWY_EXPORT(find_taps_here);
HWY_EXPORT(find_weights_here);
HWY_EXPORT(count_reads_here);
HWY_EXPORT(find_steps_here);
HWY_EXPORT(add_view_here);
HWY_EXPORT(round_row_here);
HWY_EXPORT(render_set_here);

void trace_row(const FrameRecord& record, int32_t j, RowRays& rays) {
  HWY_DYNAMIC_DISPATCH(trace_row_here)(record, j, rays);
}

void find_taps(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps) {
  HWY_DYNAMIC_DISPATCH(find_taps_here)(record, rays, run, taps);
}

void find_weights(const FrameRecord& record, const RowRays& rays, const RayRun& run,
                  RunTaps& taps) {
  HWY_DYNAMIC_DISPATCH(find_weights_here)(record, rays, run, taps);
}

uint64_t count_reads(const RayRun& run, const RunTaps& taps) {
  return HWY_DYNAMIC_DISPATCH(count_reads_here)(run, taps);
}

int32_t find_steps(const int32_t* first, const int32_t* fraction, const RayRun& run, unsigned log2,
                   int32_t* steps) {
  return HWY_DYNAMIC_DISPATCH(find_steps_here)(first, fraction, run, log2, steps);
}

void add_view(const ViewPixels& pixels, const RayRun& run, const RunTaps& taps, bool interpolated,
              int32_t col, int32_t row, uint32_t* sums) {
  HWY_DYNAMIC_DISPATCH(add_view_here)(pixels, run, taps, interpolated, col, row, sums);
}

void round_row(const uint32_t* sums, int32_t pixels, uint16_t* out) {
  HWY_DYNAMIC_DISPATCH(round_row_here)(sums, pixels, out);
}

const char* render_instruction_set() { return HWY_DYNAMIC_DISPATCH(render_set_here)(); }

}  // namespace hmlfc

#endif  // HWY_ONCE
