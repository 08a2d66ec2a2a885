// Taps and weights of a run in plain loops, which the compiler vectorises. Included once for each
// instruction set by row_kernels.cpp.

#if defined(HMLFC_RENDER_RUN_TAPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_RENDER_RUN_TAPS_INL
#undef HMLFC_RENDER_RUN_TAPS_INL
#else
#define HMLFC_RENDER_RUN_TAPS_INL
#endif

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <hwy/highway.h>

#include "render/ray.hpp"
#include "render/row_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

/// SMP-2 on one axis: from coordinates base + offset of pixels [begin, end).
inline void fill_taps(const int32_t* HWY_RESTRICT base, int32_t offset, int32_t size,
                      bool interpolated, int32_t begin, int32_t end, int32_t* HWY_RESTRICT first,
                      int32_t* HWY_RESTRICT fraction) {
  const int32_t last = (size - 1) << 12;
  if (!interpolated) {
    for (int32_t i = begin; i < end; ++i) {
      const int32_t x = base[i] + offset;
      first[i] = ((x < 0 ? 0 : x > last ? last : x) + kHalfPixel) >> 12;
      fraction[i] = 0;
    }
    return;
  }
  for (int32_t i = begin; i < end; ++i) {
    const int32_t x = base[i] + offset;
    const int32_t rounded = ((x < 0 ? 0 : x > last ? last : x) + 8) >> 4;
    first[i] = rounded >> 8;
    fraction[i] = rounded & 255;
  }
}

/// Adds the weight of view `m` of an axis (SMP-1) to `weight`.
inline void add_weights(const int32_t* HWY_RESTRICT places, int aperture, int32_t m, int32_t begin,
                        int32_t end, int32_t* HWY_RESTRICT weight) {
  const int log2 = 8 - 2 * aperture;
  const int32_t half = 1 << (15 - log2);
  const int32_t support = 1 << (log2 + aperture);
  const int32_t at = m * (1 << log2);
  for (int32_t i = begin; i < end; ++i) {
    const int32_t distance = std::abs(at - ((places[i] + half) >> (16 - log2)));
    weight[i] += distance < support ? support - distance : 0;
  }
}

/// One axis of find_taps: coordinates `base`, xb or yb, with `step` for each view from view
/// `origin`.
inline void find_axis_taps(const FrameRecord& f, const std::vector<int32_t>& base, int32_t step,
                           int32_t origin, int32_t size, int32_t first, int32_t last,
                           const RayRun& run, AxisRun& out) {
  out.first_view = first;
  out.views = last - first + 1;
  out.reserve(out.views);
  const bool interpolated = f.filter == static_cast<int32_t>(Filter::kQuadrilinear);
  for (int32_t k = 0; k < out.views; ++k) {
    fill_taps(base.data(), step * (first + k - origin), size, interpolated, run.begin, run.end,
              out.first[k].data(), out.fraction[k].data());
  }
}

inline void find_taps_here(const FrameRecord& f, const RowRays& rays, const RayRun& run,
                           RunTaps& taps) {
  find_axis_taps(f, rays.xb, f.dx, f.c0, f.width, run.first_col, run.last_col, run, taps.cols);
  find_axis_taps(f, rays.yb, f.dy, f.r0, f.height, run.first_row, run.last_row, run, taps.rows);
}

/// One axis of find_weights: places U or V in a grid of `views` views.
inline void find_axis_weights(const FrameRecord& f, const std::vector<int32_t>& places,
                              int32_t views, const RayRun& run, AxisRun& out) {
  const bool nearest = f.filter == static_cast<int32_t>(Filter::kNearest);
  for (int32_t k = 0; k < out.views; ++k) {
    std::fill(out.weight[k].begin() + run.begin, out.weight[k].begin() + run.end,
              nearest ? 256 : 0);
  }
  if (nearest) return;
  // Views outside the grid with a weight count for the view at its border.
  const int32_t steps = 1 << f.aperture;
  const int32_t first = out.first_view;
  const int32_t last = first + out.views - 1;
  const int32_t below = first == 0 ? 1 - steps : first;
  const int32_t above = last == views - 1 ? last + steps : last;
  for (int32_t m = below; m <= above; ++m) {
    add_weights(places.data(), f.aperture, m, run.begin, run.end,
                out.weight[clamp(m, first, last) - first].data());
  }
}

inline void find_weights_here(const FrameRecord& f, const RowRays& rays, const RayRun& run,
                              RunTaps& taps) {
  find_axis_weights(f, rays.u, f.cols, run, taps.cols);
  find_axis_weights(f, rays.v, f.rows, run, taps.rows);
}

/// The pixels of views that `run` reads, counted over blocks of kCounted pixels.
inline uint64_t count_reads_here(const RayRun& run, const RunTaps& taps) {
  constexpr int32_t kCounted = 64;
  const auto count_taps = [](const AxisRun& axis, int32_t begin, int32_t count, int32_t* out) {
    for (int32_t i = 0; i < count; ++i) out[i] = axis.views;
    for (int32_t k = 0; k < axis.views; ++k) {
      const int32_t* fraction = axis.fraction[k].data() + begin;
      for (int32_t i = 0; i < count; ++i) out[i] += fraction[i] != 0 ? 1 : 0;
    }
  };
  uint64_t reads = 0;
  for (int32_t begin = run.begin; begin < run.end; begin += kCounted) {
    const int32_t count = run.end - begin < kCounted ? run.end - begin : kCounted;
    int32_t cols[kCounted];
    int32_t rows[kCounted];
    count_taps(taps.cols, begin, count, cols);
    count_taps(taps.rows, begin, count, rows);
    int32_t sum = 0;
    for (int32_t i = 0; i < count; ++i) sum += cols[i] * rows[i];
    reads += static_cast<uint64_t>(sum);
  }
  return reads;
}

/// Writes the pixels of `run` at which the blocks of 2^log2 pixels change that taps `first`,
/// `fraction` read, the first pixel always; returns how many.
inline int32_t find_steps_here(const int32_t* HWY_RESTRICT first,
                               const int32_t* HWY_RESTRICT fraction, const RayRun& run,
                               unsigned log2, int32_t* HWY_RESTRICT steps) {
  constexpr int32_t kCompared = 64;
  int32_t count = 0;
  int32_t key = -1;
  for (int32_t begin = run.begin; begin < run.end; begin += kCompared) {
    const int32_t pixels = run.end - begin < kCompared ? run.end - begin : kCompared;
    int32_t keys[kCompared + 1];
    keys[0] = key;
    for (int32_t i = 0; i < pixels; ++i) {
      const int32_t at = first[begin + i];
      keys[i + 1] = (at >> log2) + ((at + (fraction[begin + i] != 0 ? 1 : 0)) >> log2);
    }
    int32_t changes = 0;
    for (int32_t i = 0; i < pixels; ++i) changes += keys[i + 1] != keys[i] ? 1 : 0;
    key = keys[pixels];
    if (changes == 0) continue;
    for (int32_t i = 0; i < pixels; ++i) {
      steps[count] = begin + i;
      count += keys[i + 1] != keys[i] ? 1 : 0;
    }
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
