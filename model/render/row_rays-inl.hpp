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

inline void trace_row_here(const FrameRecord& record, int32_t j, RowRays& rays) {
  for (int32_t i = 0; i < record.frame_width; ++i) {
    const auto ray = trace(record, i, j);
    const auto at = static_cast<size_t>(i);
    rays.u[at] = ray ? ray->u : RowRays::kOutside;
    rays.v[at] = ray ? ray->v : 0;
    rays.xb[at] = ray ? ray->xb : 0;
    rays.yb[at] = ray ? ray->yb : 0;
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

/// One row of a frame.
class RowTracer {
 public:
  RowTracer(const FrameRecord& record, int32_t j)
      : f_(record), b_(2 * j + 1 - record.frame_height) {}

  /// Traces the pixels of one vector from `begin` on; those past the row's end repeat its last.
  void trace(int32_t begin, RowRays& rays) {
    const IntVec last = set(f_.frame_width - 1);
    const IntVec a = hn::Min(
        hn::Add(set(2 * begin + 1 - f_.frame_width), hn::ShiftLeft<1>(hn::Iota(d_, 0))), last);
    IntVec nx =
        direction(a, f_.n0_hi.x, f_.n0_lo.x, f_.na_hi.x, f_.na_lo.x, f_.nb_hi.x, f_.nb_lo.x);
    IntVec ny =
        direction(a, f_.n0_hi.y, f_.n0_lo.y, f_.na_hi.y, f_.na_lo.y, f_.nb_hi.y, f_.nb_lo.y);
    IntVec nz =
        direction(a, f_.n0_hi.z, f_.n0_lo.z, f_.na_hi.z, f_.na_lo.z, f_.nb_hi.z, f_.nb_lo.z);
    // RAY-2.
    auto outside = hn::Lt(nz, set(1 << 26));
    outside = hn::Or(outside, hn::Not(hn::Lt(hn::ShiftRight<2>(hn::Abs(nx)), nz)));
    outside = hn::Or(outside, hn::Not(hn::Lt(hn::ShiftRight<2>(hn::Abs(ny)), nz)));
    nz = hn::IfThenElse(outside, set(1 << 28), nz);  // any valid divisor
    const IntVec r = reciprocals(nz);
    place(begin, multiply_shift_lanes<29>(nx, r), multiply_shift_lanes<29>(ny, r), outside, rays);
  }

 private:
  IntVec set(int32_t value) const { return hn::Set(d_, value); }

  // RAY-1.
  IntVec direction(IntVec a, int32_t n0_hi, int32_t n0_lo, int32_t na_hi, int32_t na_lo,
                   int32_t nb_hi, int32_t nb_lo) const {
    const IntVec low = hn::Add(set(n0_lo + b_ * nb_lo), hn::Mul(a, set(na_lo)));
    const IntVec high = hn::Add(set(n0_hi + b_ * nb_hi), hn::Mul(a, set(na_hi)));
    return hn::Add(high, hn::ShiftRight<12>(low));
  }

  // r of RAY-2. Cameras that look straight ahead have one n.z for all pixels.
  IntVec reciprocals(IntVec nz) {
    HWY_ALIGN int32_t values[hn::MaxLanes(Ints())];
    hn::Store(nz, d_, values);
    if (hn::AllTrue(d_, hn::Eq(nz, set(values[0])))) {
      if (values[0] != last_nz_) last_r_ = reciprocal(values[0]);
      last_nz_ = values[0];
      return set(last_r_);
    }
    for (size_t k = 0; k < hn::Lanes(d_); ++k) values[k] = reciprocal(values[k]);
    return hn::Load(d_, values);
  }

  // RAY-3 on one axis: the place, clamped; adds rays beside the grid to `outside`.
  template <class Mask>
  IntVec place_on_axis(int32_t origin, int32_t z, IntVec slope, int32_t views,
                       Mask& outside) const {
    const IntVec last = set((views - 1) << 16);
    const IntVec at = hn::Sub(set(origin), multiply_shift_lanes<28>(set(z), slope));
    if (views > 1) {
      const IntVec half = set(kHalfStep);
      outside = hn::Or(outside, hn::Lt(at, set(-kHalfStep)));
      outside = hn::Or(outside, hn::Gt(at, hn::Add(last, half)));
    }
    return hn::Min(hn::Max(at, hn::Zero(d_)), last);
  }

  // RAY-4 and RAY-5 on one axis: xb or yb.
  template <class Mask>
  IntVec picture_on_axis(int32_t origin, IntVec slope, IntVec place, int32_t step, int32_t first,
                         int32_t size, Mask& outside) const {
    const IntVec base = hn::Add(set(origin), multiply_shift_lanes<28>(set(f_.gain), slope));
    const IntVec nearest = hn::ShiftRight<16>(hn::Add(place, set(kHalfStep)));
    const IntVec at = hn::Add(base, hn::Mul(set(step), hn::Sub(nearest, set(first))));
    outside = hn::Or(outside, hn::Lt(at, set(-kHalfPixel)));
    outside = hn::Or(outside, hn::Gt(at, set((size << 12) - kHalfPixel - 1)));
    return base;
  }

  template <class Mask>
  void place(int32_t begin, IntVec sx, IntVec sy, Mask outside, RowRays& rays) const {
    const IntVec u = place_on_axis(f_.u0, f_.zu, sx, f_.cols, outside);
    const IntVec v = place_on_axis(f_.v0, f_.zv, sy, f_.rows, outside);
    const IntVec xb = picture_on_axis(f_.x0, sx, u, f_.dx, f_.c0, f_.width, outside);
    const IntVec yb = picture_on_axis(f_.y0, sy, v, f_.dy, f_.r0, f_.height, outside);
    hn::StoreU(hn::IfThenElse(outside, set(RowRays::kOutside), u), d_, rays.u.data() + begin);
    hn::StoreU(v, d_, rays.v.data() + begin);
    hn::StoreU(xb, d_, rays.xb.data() + begin);
    hn::StoreU(yb, d_, rays.yb.data() + begin);
  }

  const Ints d_{};
  const FrameRecord& f_;
  int32_t b_;
  int32_t last_nz_ = 0;
  int32_t last_r_ = 0;
};

inline void trace_row_here(const FrameRecord& record, int32_t j, RowRays& rays) {
  RowTracer tracer(record, j);
  const auto lanes = static_cast<int32_t>(hn::Lanes(Ints()));
  for (int32_t begin = 0; begin < record.frame_width; begin += lanes) tracer.trace(begin, rays);
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
