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

/// Input of find_taps along one axis: coordinates `base`, xb or yb, with `step` for each view from
/// view `origin`; Us or Vs, and the pitch of the views, for what is displaced.
struct TapAxis {
  const int32_t* base;
  int32_t step;
  int32_t origin;
  int32_t size;
  const int32_t* displaced_place;
  int32_t pitch;
};

/// x(c, E) or y(r, E) of SRF-2 in view `view`, of pixels [begin, end) with displacements `e`.
inline void displace(const TapAxis& axis, const int32_t* HWY_RESTRICT e, int32_t view,
                     int32_t begin, int32_t end, int32_t* HWY_RESTRICT places) {
  const int32_t offset = axis.step * (view - axis.origin);
  const int32_t pitch = axis.pitch;
  const int32_t* HWY_RESTRICT base = axis.base;
  const int32_t* HWY_RESTRICT us = axis.displaced_place;
  for (int32_t i = begin; i < end; ++i) {
    const int32_t g = (e[i] * pitch + (1 << 7)) >> 8;
    places[i] = base[i] + offset + ((g * (view * (1 << 12) - (us[i] >> 4))) >> 8);
  }
}

inline void find_axis_taps(const FrameRecord& f, const RowRays& rays, const TapAxis& axis,
                           const RayRun& run, AxisRun& out) {
  const bool interpolated = f.filter == static_cast<int32_t>(Filter::kQuadrilinear);
  const auto last_pixel = static_cast<size_t>(run.end - 1);
  for (int32_t k = 0; k < out.views; ++k) {
    const int32_t* places = axis.base;
    int32_t offset = axis.step * (out.first_view + k - axis.origin);
    if (rays.displaced) {
      displace(axis, rays.e.data(), out.first_view + k, run.begin, run.end, out.places.data());
      places = out.places.data();
      offset = 0;
    }
    fill_taps(places, offset, axis.size, interpolated, run.begin, run.end, out.first[k].data(),
              out.pixel_weights[k].data());
    std::fill_n(out.first[k].begin() + run.end, AxisRun::kSpare, out.first[k][last_pixel]);
  }
}

inline void find_taps_here(const FrameRecord& f, const RowRays& rays, const RayRun& run,
                           RunTaps& taps) {
  constexpr int32_t kColumns = 1 << 8;  // the pitch of columns
  const TapAxis x{rays.xb.data(), f.dx, f.c0, f.width, rays.us.data(), kColumns};
  const TapAxis y{rays.yb.data(), f.dy, f.r0, f.height, rays.vs.data(), f.pitch};
  taps.choose(run);
  if (!rays.same_columns || rays.displaced) find_axis_taps(f, rays, x, run, taps.cols);
  find_axis_taps(f, rays, y, run, taps.rows);
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
  taps.choose(run);
  if (!rays.same_columns) find_axis_weights(f, rays.u, f.cols, run, taps.cols);
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
template <class KeyAt, class Visit>
HWY_INLINE void for_each_change(int32_t begin, int32_t end, const KeyAt& key_at,
                                const Visit& visit) {
  constexpr int32_t kCompared = 64;
  if (begin < end) visit(begin++);
  for (; begin < end; begin += kCompared) {
    const int32_t block_end = end - begin < kCompared ? end : begin + kCompared;
    int32_t changes = 0;
    for (int32_t i = begin; i < block_end; ++i) changes += key_at(i) != key_at(i - 1) ? 1 : 0;
    for (int32_t i = begin; changes != 0; ++i) {
      if (key_at(i) == key_at(i - 1)) continue;
      visit(i);
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

/// first() and last() of GridWeights in a form that the compiler vectorises.
struct ViewsOnAxis {
  ViewsOnAxis(const FrameRecord& f, int32_t views) : last(views - 1) {
    if (f.filter == static_cast<int32_t>(Filter::kNearest)) return;
    const AxisWeights axis = axis_weights(0, f.aperture);
    log2 = axis.log2;
    steps = 1 << f.aperture;
  }

  /// In 16 bits: the first view with a weight in the upper 12, how many follow it in the lower 4.
  /// Grids have at most 4096 columns and rows.
  HWY_INLINE int32_t key(int32_t place) const {
    const int32_t at = (place + (1 << (15 - log2))) >> (16 - log2);
    const int32_t below = at >> log2;
    const int32_t between = at - (below << log2) != 0 ? 1 : 0;
    const int32_t low = std::min(std::max(below - steps + 1, 0), last);
    const int32_t high = std::min(std::max(below + steps - 1 + between, 0), last);
    return (low << 4) + (high - low);
  }

  int32_t last;
  int32_t log2 = 0;  ///< k of SMP-1
  int32_t steps = 1;
};

inline constexpr int32_t kNoViews = -1;  // no view follows the last, 4095

inline void find_view_keys(const FrameRecord& f, int32_t pixels, RowRays& rays) {
  const int32_t* HWY_RESTRICT u = rays.u.data();
  const int32_t* HWY_RESTRICT v = rays.v.data();
  int32_t* HWY_RESTRICT keys = rays.view_keys.data();
  const ViewsOnAxis cols(f, f.cols);
  const ViewsOnAxis rows(f, f.rows);
  for (int32_t i = 0; i < pixels; ++i) {
    const auto col_key = static_cast<uint32_t>(cols.key(u[i]));
    const auto key = static_cast<int32_t>(col_key << 16 | static_cast<uint32_t>(rows.key(v[i])));
    keys[i] = u[i] == RowRays::kOutside ? kNoViews : key;
  }
}

inline void find_runs_here(const FrameRecord& f, int32_t pixels, RowRays& rays) {
  find_view_keys(f, pixels, rays);
  const int32_t* keys = rays.view_keys.data();
  std::vector<RayRun>& runs = rays.all_runs;
  runs.clear();
  bool open = false;
  const auto key_at = [keys](int32_t i) { return keys[i]; };
  for_each_change(0, pixels, key_at, [&](int32_t i) {
    if (open) runs.back().end = i;
    open = keys[i] != kNoViews;
    if (!open) return;
    const auto key = static_cast<uint32_t>(keys[i]);
    const auto bits = [key](unsigned at, uint32_t mask) {
      return static_cast<int32_t>(key >> at & mask);
    };
    RayRun run;
    run.begin = i;
    run.first_col = bits(20, 4095);
    run.last_col = run.first_col + bits(16, 15);
    run.first_row = bits(4, 4095);
    run.last_row = run.first_row + bits(0, 15);
    runs.push_back(run);
  });
  if (open) runs.back().end = pixels;
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
