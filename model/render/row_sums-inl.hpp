// Interpolation and weighted sums of a run of pixels, pixel by pixel with its samples in one
// vector. Included once for each instruction set by row_kernels.cpp.

#if defined(HMLFC_RENDER_ROW_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_RENDER_ROW_SUMS_INL
#undef HMLFC_RENDER_ROW_SUMS_INL
#else
#define HMLFC_RENDER_ROW_SUMS_INL
#endif

#include <type_traits>

#include <hwy/highway.h>

#include "render/row_kernels.hpp"
#include "render/taps.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

/// The taps and weights of a run in one view.
struct TapArrays {
  TapArrays(const RunTaps& taps, int32_t col, int32_t row)
      : x(taps.cols.first[col].data()),
        y(taps.rows.first[row].data()),
        fx(taps.cols.fraction[col].data()),
        fy(taps.rows.fraction[row].data()),
        wx(taps.cols.weight[col].data()),
        wy(taps.rows.weight[row].data()) {}

  const int32_t* x;
  const int32_t* y;
  const int32_t* fx;
  const int32_t* fy;
  const int32_t* wx;
  const int32_t* wy;

  uint32_t weight(int32_t i) const { return static_cast<uint32_t>(wx[i] * wy[i]); }
};

#if HWY_TARGET == HWY_SCALAR

template <int kSampleBytes>
void add_interpolated(const uint8_t* const* rows, const RayRun& run, const TapArrays& taps,
                      uint32_t* sums) {
  using Sample = std::conditional_t<kSampleBytes == 1, uint8_t, uint16_t>;
  constexpr int kMaxDepth = kSampleBytes == 1 ? 8 : 12;
  for (int32_t i = run.begin; i < run.end; ++i) {
    const AxisTaps x{taps.x[i], taps.fx[i]};
    const AxisTaps y{taps.y[i], taps.fy[i]};
    const auto* above = reinterpret_cast<const Sample*>(rows[y.first]) + 4 * x.first;
    const auto* below = reinterpret_cast<const Sample*>(rows[y.last()]) + 4 * x.first;
    for (int32_t k = 0; k < 3; ++k) {
      const int32_t q =
          interpolate_pixels(x, y, above[k], above[k + 4], below[k], below[k + 4], kMaxDepth);
      sums[4 * i + k] += taps.weight(i) * static_cast<uint32_t>(q);
    }
  }
}

template <int kSampleBytes>
void add_nearest(const uint8_t* const* rows, const RayRun& run, const TapArrays& taps,
                 uint32_t* sums) {
  add_interpolated<kSampleBytes>(rows, run, taps, sums);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Samples = hn::FixedTag<uint32_t, 4>;  // of one pixel
using Vector = hn::Vec<Samples>;

/// p + (q - p) * fraction / 256, times 256: exact, all values below 2^24.
inline Vector between(Vector p, Vector q, Vector fraction) {
  return hn::Add(hn::ShiftLeft<8>(p), hn::Mul(hn::Sub(q, p), fraction));
}

/// Loads pixels of kSampleBytes a sample.
template <int kSampleBytes>
struct PixelLoader;

template <>
struct PixelLoader<1> {
  static constexpr size_t kPixelBytes = 4;

  /// 256 times the mean of a pixel above and one below, and of their right neighbours.
  static void load_pair(const uint8_t* above, const uint8_t* below, int32_t fraction, Vector& left,
                        Vector& right) {
    // (above << 8) + (below - above) * fraction is at most 65280: exact modulo 2^16.
    const hn::FixedTag<uint8_t, 8> bytes;
    const hn::FixedTag<uint16_t, 8> words;
    const auto a = hn::PromoteTo(words, hn::LoadU(bytes, above));
    const auto b = hn::PromoteTo(words, hn::LoadU(bytes, below));
    const auto f = hn::Set(words, static_cast<uint16_t>(fraction));
    const auto mean = hn::Add(hn::ShiftLeft<8>(a), hn::Mul(hn::Sub(b, a), f));
    const Samples samples;
    const hn::Half<decltype(words)> half;
    left = hn::PromoteTo(samples, hn::LowerHalf(half, mean));
    right = hn::PromoteTo(samples, hn::UpperHalf(half, mean));
  }

  static Vector load(const uint8_t* pixel) {
    return hn::PromoteTo(Samples(), hn::LoadU(hn::FixedTag<uint8_t, 4>(), pixel));
  }
};

template <>
struct PixelLoader<2> {
  static constexpr size_t kPixelBytes = 8;

  static void load_pair(const uint8_t* above, const uint8_t* below, int32_t fraction, Vector& left,
                        Vector& right) {
    const Vector f = hn::Set(Samples(), static_cast<uint32_t>(fraction));
    left = between(load(above), load(below), f);
    right = between(load(above + kPixelBytes), load(below + kPixelBytes), f);
  }

  static Vector load(const uint8_t* pixel) {
    const hn::FixedTag<uint16_t, 4> words;
    return hn::PromoteTo(Samples(), hn::LoadU(words, reinterpret_cast<const uint16_t*>(pixel)));
  }
};

template <int kSampleBytes>
void add_interpolated(const uint8_t* const* rows, const RayRun& run, const TapArrays& taps,
                      uint32_t* HWY_RESTRICT sums) {
  using Loader = PixelLoader<kSampleBytes>;
  const Samples samples;
  const Vector half = hn::Set(samples, 1u << 11);
  for (int32_t i = run.begin; i < run.end; ++i) {
    const size_t at = static_cast<size_t>(taps.x[i]) * Loader::kPixelBytes;
    const int32_t y = taps.y[i];
    Vector left;
    Vector right;
    Loader::load_pair(rows[y] + at, rows[y + (taps.fy[i] != 0 ? 1 : 0)] + at, taps.fy[i], left,
                      right);
    const Vector sum = between(left, right, hn::Set(samples, static_cast<uint32_t>(taps.fx[i])));
    const Vector q = hn::ShiftRight<12>(hn::Add(sum, half));
    uint32_t* out = sums + size_t{4} * static_cast<size_t>(i);
    hn::StoreU(hn::Add(hn::LoadU(samples, out), hn::Mul(q, hn::Set(samples, taps.weight(i)))),
               samples, out);
  }
}

template <int kSampleBytes>
void add_nearest(const uint8_t* const* rows, const RayRun& run, const TapArrays& taps,
                 uint32_t* HWY_RESTRICT sums) {
  using Loader = PixelLoader<kSampleBytes>;
  const Samples samples;
  for (int32_t i = run.begin; i < run.end; ++i) {
    const size_t at = static_cast<size_t>(taps.x[i]) * Loader::kPixelBytes;
    const Vector q = hn::ShiftLeft<4>(Loader::load(rows[taps.y[i]] + at));
    uint32_t* out = sums + size_t{4} * static_cast<size_t>(i);
    hn::StoreU(hn::Add(hn::LoadU(samples, out), hn::Mul(q, hn::Set(samples, taps.weight(i)))),
               samples, out);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

inline void add_view_here(const ViewPixels& pixels, const RayRun& run, const RunTaps& taps,
                          bool interpolated, int32_t col, int32_t row, uint32_t* sums) {
  const TapArrays arrays(taps, col, row);
  if (interpolated) {
    pixels.two_bytes ? add_interpolated<2>(pixels.rows, run, arrays, sums)
                     : add_interpolated<1>(pixels.rows, run, arrays, sums);
  } else {
    pixels.two_bytes ? add_nearest<2>(pixels.rows, run, arrays, sums)
                     : add_nearest<1>(pixels.rows, run, arrays, sums);
  }
}

/// SMP-3.
inline void round_row_here(const uint32_t* HWY_RESTRICT sums, int32_t pixels,
                           uint16_t* HWY_RESTRICT out) {
  for (int32_t i = 0; i < pixels; ++i) {
    for (int32_t k = 0; k < 3; ++k) {
      out[3 * i + k] = static_cast<uint16_t>((sums[4 * i + k] + (1u << 19)) >> 20);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
