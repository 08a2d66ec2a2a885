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
                      int32_t* HWY_RESTRICT pixel_weights) {
  const int32_t last = (size - 1) << 12;
  if (!interpolated) {
    for (int32_t i = begin; i < end; ++i) {
      const int32_t x = base[i] + offset;
      first[i] = ((x < 0 ? 0 : x > last ? last : x) + kHalfPixel) >> 12;
      pixel_weights[i] = AxisRun::kFirstAlone;
    }
    return;
  }
  for (int32_t i = begin; i < end; ++i) {
    const int32_t x = base[i] + offset;
    const int32_t rounded = ((x < 0 ? 0 : x > last ? last : x) + 8) >> 4;
    first[i] = rounded >> 8;
    const int32_t fraction = rounded & 255;
    pixel_weights[i] = (fraction << 16) + (256 - fraction);
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
  const auto last_pixel = static_cast<size_t>(run.end - 1);
  for (int32_t k = 0; k < out.views; ++k) {
    fill_taps(base.data(), step * (first + k - origin), size, interpolated, run.begin, run.end,
              out.first[k].data(), out.pixel_weights[k].data());
    std::fill_n(out.first[k].begin() + run.end, AxisRun::kSpare, out.first[k][last_pixel]);
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
      const int32_t* weights = axis.pixel_weights[k].data() + begin;
      for (int32_t i = 0; i < count; ++i) out[i] += weights[i] != AxisRun::kFirstAlone ? 1 : 0;
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

inline bool is_steady_here(const AxisRun& axis, int32_t k, const RayRun& run, int32_t step) {
  const int32_t* HWY_RESTRICT first = axis.first[k].data();
  int32_t least = 0;
  int32_t most = 0;
  for (int32_t i = run.begin + 1; i < run.end; ++i) {
    const int32_t rise = first[i] - first[i - 1];
    least = std::min(least, rise);
    most = std::max(most, rise);
  }
  return (least == 0 && most <= step) || (most == 0 && least >= -step);
}

/// Calls visit(i) for each i of [begin, end) whose key differs from the one before, and for
/// `begin`. Keys are compared in blocks, which mostly have no change.
template <class KeyOf, class Visit>
HWY_INLINE void for_each_change(int32_t begin, int32_t end, const KeyOf& key_of,
                                const Visit& visit) {
  constexpr int32_t kCompared = 64;
  using Key = decltype(key_of(begin));
  Key before = ~key_of(begin);
  for (; begin < end; begin += kCompared) {
    const int32_t pixels = end - begin < kCompared ? end - begin : kCompared;
    Key keys[kCompared + 1];
    keys[0] = before;
    for (int32_t i = 0; i < pixels; ++i) keys[i + 1] = key_of(begin + i);
    int32_t changes = 0;
    for (int32_t i = 0; i < pixels; ++i) changes += keys[i + 1] != keys[i] ? 1 : 0;
    before = keys[pixels];
    for (int32_t i = 0; changes != 0; ++i) {
      if (keys[i + 1] == keys[i]) continue;
      visit(begin + i);
      --changes;
    }
  }
}

inline int32_t find_steps_here(const AxisRun& axis, int32_t k, const RayRun& run, unsigned log2,
                               int32_t* steps) {
  const int32_t* HWY_RESTRICT first = axis.first[k].data();
  const int32_t* HWY_RESTRICT weights = axis.pixel_weights[k].data();
  int32_t count = 0;
  for_each_change(
      run.begin, run.end,
      [&](int32_t i) {
        const int32_t last = first[i] + (weights[i] != AxisRun::kFirstAlone ? 1 : 0);
        return (first[i] >> log2) + (last >> log2);
      },
      [&](int32_t i) { steps[count++] = i; });
  return count;
}

/// The views with a weight on one axis in 16 bits: the first in the upper 12, how many follow it in
/// the lower 4. Grids have at most 4096 columns and rows.
inline uint32_t views_key(const GridWeights& weights) {
  return static_cast<uint32_t>(weights.first() << 4 | (weights.last() - weights.first()));
}

template <class WeightsAt>
HWY_INLINE int32_t find_runs_of(const FrameRecord& f, const RowRays& rays,
                                const WeightsAt& weights_at, RayRun* runs) {
  constexpr uint32_t kOutside = ~0u;  // no view follows the last, 4095
  const int32_t* HWY_RESTRICT u = rays.u.data();
  const int32_t* HWY_RESTRICT v = rays.v.data();
  const int32_t cols = f.cols;
  const int32_t rows = f.rows;
  const auto key_of = [&](int32_t i) {
    const uint32_t key = views_key(GridWeights(weights_at(u[i]), cols)) << 16 |
                         views_key(GridWeights(weights_at(v[i]), rows));
    return u[i] == RowRays::kOutside ? kOutside : key;
  };
  int32_t count = 0;
  bool open = false;
  const auto close = [&](int32_t end) {
    if (open) runs[count++].end = end;
    open = false;
  };
  for_each_change(0, f.frame_width, key_of, [&](int32_t i) {
    close(i);
    const uint32_t key = key_of(i);
    if (key == kOutside) return;
    const auto first_col = static_cast<int32_t>(key >> 20);
    const auto first_row = static_cast<int32_t>(key >> 4 & 4095);
    runs[count] = {i,         i,
                   first_col, first_col + static_cast<int32_t>(key >> 16 & 15),
                   first_row, first_row + static_cast<int32_t>(key & 15)};
    open = true;
  });
  close(f.frame_width);
  return count;
}

inline int32_t find_runs_here(const FrameRecord& f, const RowRays& rays, RayRun* runs) {
  if (f.filter == static_cast<int32_t>(Filter::kNearest)) {
    return find_runs_of(
        f, rays, [](int32_t place) { return nearest_weights(place); }, runs);
  }
  const int aperture = f.aperture;
  return find_runs_of(
      f, rays, [aperture](int32_t place) { return axis_weights(place, aperture); }, runs);
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
