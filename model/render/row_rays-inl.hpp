// The rays of a row, a vector of pixels at a time. Included once for each instruction set by
// row_kernels.cpp.

#if defined(HMLFC_RENDER_ROW_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_RENDER_ROW_RAYS_INL
#undef HMLFC_RENDER_ROW_RAYS_INL
#else
#define HMLFC_RENDER_ROW_RAYS_INL
#endif

#include <hwy/highway.h>

#include "render/ray.hpp"
#include "render/row_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

inline void trace_row_here(const FrameRecord& record, const RayRow& row, RowRays& rays) {
  for (int32_t i = 0; i < row.count; ++i) {
    const auto ray = trace(record, direction(record, row.a_of(i), row.b));
    const auto at = static_cast<size_t>(i);
    rays.u[at] = ray ? ray->u : RowRays::kOutside;
    rays.v[at] = ray ? ray->v : 0;
    rays.xb[at] = ray ? ray->xb : 0;
    rays.yb[at] = ray ? ray->yb : 0;
    rays.us[at] = ray ? ray->us : 0;
    rays.vs[at] = ray ? ray->vs : 0;
  }
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Ints = hn::ScalableTag<int32_t>;
using IntVec = hn::Vec<Ints>;
static_assert(HWY_MAX_BYTES / sizeof(int32_t) <= RowRays::kSpare);

/// floor((a * b) / 2^kShift) of each lane, the product in 64 bits; the result fits in 32.
template <int kShift>
inline IntVec multiply_shift_lanes(IntVec a, IntVec b) {
  const Ints ints;
  const hn::RepartitionToWide<hn::RebindToUnsigned<Ints> > wide;
  const auto upper = [&](IntVec v) {
    return hn::BitCast(ints, hn::ShiftRight<32>(hn::BitCast(wide, v)));
  };
  const auto even = hn::BitCast(wide, hn::MulEven(a, b));
  const auto odd = hn::BitCast(wide, hn::MulEven(upper(a), upper(b)));
  return hn::OddEven(hn::BitCast(ints, hn::ShiftLeft<32 - kShift>(odd)),
                     hn::BitCast(ints, hn::ShiftRight<kShift>(even)));
}

/// r of RAY-2 for divisors in [2^26, 2^30 - 1]: one division in binary64, made exact. A quotient
/// rounded to the nearest and then towards 0 is at most one too large, and is so exactly where its
/// product with the divisor reaches 2^57.
inline IntVec reciprocals(IntVec nz) {
  const Ints ints;
  const hn::RepartitionToWide<Ints> wide;
  const hn::Repartition<double, Ints> reals;
  const hn::Half<Ints> half;
  const auto quotient = [&](auto part) {
    const auto dividend = hn::Set(reals, 144115188075855872.0);  // 2^57
    return hn::DemoteTo(half, hn::Div(dividend, hn::PromoteTo(reals, part)));
  };
  const IntVec r =
      hn::Combine(ints, quotient(hn::UpperHalf(half, nz)), quotient(hn::LowerHalf(half, nz)));
  const auto upper = [&](IntVec v) {
    return hn::BitCast(ints, hn::ShiftRight<32>(hn::BitCast(wide, v)));
  };
  const auto even = hn::ShiftRight<57>(hn::MulEven(r, nz));
  const auto odd = hn::ShiftRight<57>(hn::MulEven(upper(r), upper(nz)));
  return hn::Sub(r, hn::BitCast(ints, hn::Or(even, hn::ShiftLeft<32>(odd))));
}

/// RAY-1 along a row.
struct RowDirection {
  HWY_INLINE RowDirection(int32_t b, int32_t n0_hi, int32_t n0_lo, int32_t na_hi, int32_t na_lo,
                          int32_t nb_hi, int32_t nb_lo)
      : high(hn::Set(Ints(), n0_hi + b * nb_hi)),
        low(hn::Set(Ints(), n0_lo + b * nb_lo)),
        step_high(hn::Set(Ints(), na_hi)),
        step_low(hn::Set(Ints(), na_lo)) {}

  HWY_INLINE IntVec at(IntVec a) const {
    const IntVec fraction = hn::Add(low, hn::Mul(a, step_low));
    return hn::Add(hn::Add(high, hn::Mul(a, step_high)), hn::ShiftRight<12>(fraction));
  }

  IntVec high;
  IntVec low;
  IntVec step_high;
  IntVec step_low;
};

/// RAY-3 to RAY-5 along one axis.
struct AxisTracer {
  HWY_INLINE AxisTracer(int32_t place, int32_t z, int32_t views, int32_t base, int32_t gain_,
                        int32_t step_, int32_t first_, int32_t size)
      : place_0(hn::Set(Ints(), place)),
        shift(hn::Set(Ints(), z)),
        last(hn::Set(Ints(), (views - 1) << 16)),
        margin(hn::Set(Ints(), views > 1 ? kHalfStep : INT32_MAX)),
        base_0(hn::Set(Ints(), base)),
        gain(hn::Set(Ints(), gain_)),
        step(hn::Set(Ints(), step_)),
        first(hn::Set(Ints(), first_)),
        end(hn::Set(Ints(), (size << 12) - kHalfPixel - 1)) {}

  template <class Mask>
  HWY_INLINE void trace(IntVec slope, IntVec& at, IntVec& place, IntVec& base,
                        Mask& outside) const {
    const Ints ints;
    const IntVec zero = hn::Zero(ints);
    at = hn::Sub(place_0, multiply_shift_lanes<28>(shift, slope));
    place = hn::Min(hn::Max(at, zero), last);
    base = hn::Add(base_0, multiply_shift_lanes<28>(gain, slope));
    const IntVec nearest = hn::ShiftRight<16>(hn::Add(place, hn::Set(ints, kHalfStep)));
    const IntVec x = hn::Add(base, hn::Mul(step, hn::Sub(nearest, first)));
    outside = hn::Or(outside, hn::Gt(hn::Abs(hn::Sub(at, place)), margin));
    outside = hn::Or(outside, hn::Lt(x, hn::Set(ints, -kHalfPixel)));
    outside = hn::Or(outside, hn::Gt(x, end));
  }

  /// Us or Vs of SRF-2 from the place before it is clamped.
  HWY_INLINE IntVec displaced(IntVec at) const {
    const IntVec half = hn::Set(Ints(), kHalfStep);
    return hn::Min(hn::Max(at, hn::Neg(half)), hn::Add(last, half));
  }

  IntVec place_0;
  IntVec shift;
  IntVec last;
  IntVec margin;
  IntVec base_0;
  IntVec gain;
  IntVec step;
  IntVec first;
  IntVec end;
};

inline void trace_row_here(const FrameRecord& f, const RayRow& row, RowRays& rays) {
  const Ints ints;
  const int32_t b = row.b;
  const RowDirection x(b, f.n0_hi.x, f.n0_lo.x, f.na_hi.x, f.na_lo.x, f.nb_hi.x, f.nb_lo.x);
  const RowDirection y(b, f.n0_hi.y, f.n0_lo.y, f.na_hi.y, f.na_lo.y, f.nb_hi.y, f.nb_lo.y);
  const RowDirection z(b, f.n0_hi.z, f.n0_lo.z, f.na_hi.z, f.na_lo.z, f.nb_hi.z, f.nb_lo.z);
  const AxisTracer cols(f.u0, f.zu, f.cols, f.x0, f.gain, f.dx, f.c0, f.width);
  const AxisTracer rows(f.v0, f.zv, f.rows, f.y0, f.gain, f.dy, f.r0, f.height);
  const IntVec least_z = hn::Set(ints, 1 << 26);
  // Cameras that do not turn sideways have one n.z in all pixels of a row.
  const bool one_z = f.na_hi.z == 0 && f.na_lo.z == 0;
  const IntVec row_w = reciprocals(hn::Max(z.at(hn::Zero(ints)), least_z));
  // Pixels past the row's end repeat its last.
  const IntVec last_a = hn::Set(ints, row.last);
  const IntVec steps = hn::Mul(hn::Set(ints, row.step), hn::Iota(ints, 0));
  const auto lanes = static_cast<int32_t>(hn::Lanes(ints));
  for (int32_t begin = 0; begin < row.count; begin += lanes) {
    const IntVec a = hn::Min(last_a, hn::Add(hn::Set(ints, row.a + row.step * begin), steps));
    const IntVec nx = x.at(a);
    const IntVec ny = y.at(a);
    const IntVec nz = z.at(a);
    // RAY-2.
    auto outside = hn::Lt(nz, least_z);
    outside = hn::Or(outside, hn::Not(hn::Lt(hn::ShiftRight<2>(hn::Abs(nx)), nz)));
    outside = hn::Or(outside, hn::Not(hn::Lt(hn::ShiftRight<2>(hn::Abs(ny)), nz)));
    const IntVec w = one_z ? row_w : reciprocals(hn::Max(nz, least_z));
    IntVec at_u, at_v, u, v, xb, yb;
    cols.trace(multiply_shift_lanes<29>(nx, w), at_u, u, xb, outside);
    rows.trace(multiply_shift_lanes<29>(ny, w), at_v, v, yb, outside);
    if (f.geometry != 0) {
      hn::StoreU(cols.displaced(at_u), ints, rays.us.data() + begin);
      hn::StoreU(rows.displaced(at_v), ints, rays.vs.data() + begin);
    }
    const IntVec none = hn::Set(ints, RowRays::kOutside);
    hn::StoreU(hn::IfThenElse(outside, none, u), ints, rays.u.data() + begin);
    hn::StoreU(v, ints, rays.v.data() + begin);
    hn::StoreU(xb, ints, rays.xb.data() + begin);
    hn::StoreU(yb, ints, rays.yb.data() + begin);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
