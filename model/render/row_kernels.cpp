#include "render/row_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/row_kernels.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

#include "render/row_rays-inl.hpp"
#include "render/run_samples-inl.hpp"
#include "render/run_taps-inl.hpp"

#if HWY_ONCE

#include <algorithm>

namespace hmlfc {

HWY_EXPORT(trace_row_here);
HWY_EXPORT(find_runs_here);
HWY_EXPORT(find_taps_here);
HWY_EXPORT(find_weights_here);
HWY_EXPORT(count_reads_here);
HWY_EXPORT(is_steady_here);
HWY_EXPORT(find_steps_here);
HWY_EXPORT(sample_run_here);

namespace {

// trace_row() where the row has the columns of the row before: the rays of all its pixels are the
// same in y.
void trace_same_columns(const FrameRecord& record, const RayRow& row, RowRays& rays) {
  const int32_t a = row.a_of(rays.all_runs.front().begin);
  const auto ray = trace(record, direction(record, a, row.b));
  rays.inside = ray.has_value();
  if (!ray) return;
  std::fill_n(rays.v.begin(), row.count, ray->v);
  std::fill_n(rays.yb.begin(), row.count, ray->yb);
  if (record.geometry != 0) std::fill_n(rays.vs.begin(), row.count, ray->vs);
  const GridWeights rows(axis_weights(record, ray->v), record.rows);
  for (RayRun& run : rays.all_runs) {
    run.first_row = rows.first();
    run.last_row = rows.last();
  }
}

}  // namespace

void trace_row(const FrameRecord& record, const RayRow& row, RowRays& rays) {
  rays.same_columns = looks_along_z(record) && !rays.all_runs.empty();
  if (rays.same_columns) {
    trace_same_columns(record, row, rays);
  } else {
    HWY_DYNAMIC_DISPATCH(trace_row_here)(record, row, rays);
    HWY_DYNAMIC_DISPATCH(find_runs_here)(record, row.count, rays);
  }
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

bool is_steady(const AxisRun& axis, int32_t k, const RayRun& run, int32_t step) {
  return HWY_DYNAMIC_DISPATCH(is_steady_here)(axis, k, run, step);
}

int32_t find_steps(const AxisRun& axis, int32_t k, const RayRun& run, unsigned log2,
                   int32_t* steps) {
  return HWY_DYNAMIC_DISPATCH(find_steps_here)(axis, k, run, log2, steps);
}

void sample_run(const RayRun& run, const RunTaps& taps, const RunViews& views, bool interpolated,
                uint16_t* out) {
  HWY_DYNAMIC_DISPATCH(sample_run_here)(run, taps, views, interpolated, out);
}

}  // namespace hmlfc

#endif  // HWY_ONCE
