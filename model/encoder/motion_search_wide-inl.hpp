// Candidates in 32-bit lanes. Included once for each instruction set.
#if defined(HMLFC_MOTION_SEARCH_WIDE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_MOTION_SEARCH_WIDE_INL
#undef HMLFC_MOTION_SEARCH_WIDE_INL
#else
#define HMLFC_MOTION_SEARCH_WIDE_INL
#endif

#include <hwy/highway.h>

#include "encoder/motion_search_lanes-inl.hpp"
#include "encoder/motion_search_request.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

/// Evaluates lanes() candidates at once, one in each lane, whatever their sad; the interface is
/// that of NarrowKernel. It serves the rare blocks that nothing in the reference resembles, for
/// which a bound would exclude little.
///
/// |b - r| and |b + r| of samples in [-16382, 16382] are at most 32764 and fit in int16; the sum of
/// two is at most 65528 and fits in uint16; 64 of them are at most 2,096,896 and fit in int32.
template <int kSize, bool kBothSigns>
class WideKernel {
  using D32 = hn::CappedTag<int32_t, ReferencePlane::kReadAhead / 2>;
  using D16 = hn::Rebind<int16_t, D32>;
  using DU16 = hn::Rebind<uint16_t, D32>;
  using V16 = hn::Vec<D16>;
  using V32 = hn::Vec<D32>;

 public:
  static constexpr bool kHasBound = false;

  explicit WideKernel(const MotionRequest& request) : block_(request.block) {}

  /// Candidates of one group, [1, 16].
  static int lanes() { return static_cast<int>(hn::Lanes(D32())); }

  template <bool kColumns>
  HWY_INLINE void evaluate(const int16_t* r, ptrdiff_t row_step, ptrdiff_t column_step,
                           const MotionGroup& group, MotionBest& best) const {
    const int64_t limit = best.limit(group.least_length);
    if (limit < 0) {
      return;
    }
    const D16 d;
    const D32 d32;
    const ptrdiff_t next = kColumns ? column_step : 1;
    const int16_t* b = block_;
    V32 plus = hn::Zero(d32);
    V32 minus = hn::Zero(d32);
    for (int row = 0; row < kSize; ++row) {
      for (int col = 0; col < kSize; col += 2) {
        const V16 b0 = hn::Set(d, b[col]);
        const V16 b1 = hn::Set(d, b[col + 1]);
        const V16 r0 = hn::LoadU(d, r + col * next);
        const V16 r1 = hn::LoadU(d, r + (col + 1) * next);
        plus = add_pair(hn::Sub(b0, r0), hn::Sub(b1, r1), plus);
        if (kBothSigns) {
          minus = add_pair(hn::Add(b0, r0), hn::Add(b1, r1), minus);
        }
      }
      r += row_step;
      b += kSize;
    }
    const V32 least = kBothSigns ? hn::Min(plus, minus) : plus;
    if (any_candidate(d32, at_most_i32(d32, least, limit), group.count)) {
      offer_least<kBothSigns>(d32, plus, minus, group, best);
    }
  }

 private:
  static HWY_INLINE V32 add_pair(V16 first, V16 second, V32 sum) {
    const DU16 du;
    const auto pair = hn::BitCast(du, hn::Add(hn::Abs(first), hn::Abs(second)));
    return hn::Add(sum, hn::PromoteTo(D32(), pair));
  }

  const int16_t* block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif  // HMLFC_MOTION_SEARCH_WIDE_INL
