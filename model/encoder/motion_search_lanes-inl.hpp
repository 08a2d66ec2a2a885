// From lanes to candidates: what the kernels of the motion search share. Included once for each
// instruction set.
#if defined(HMLFC_MOTION_SEARCH_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_MOTION_SEARCH_LANES_INL
#undef HMLFC_MOTION_SEARCH_LANES_INL
#else
#define HMLFC_MOTION_SEARCH_LANES_INL
#endif

#include <hwy/highway.h>

#include "encoder/motion_search_request.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The lanes of uint16 values that are <= limit, limit in [0, 65534].
template <class D>
HWY_INLINE hn::Mask<D> at_most_u16(D d, hn::Vec<D> values, int64_t limit) {
  const auto excess = hn::SaturatedSub(values, hn::Set(d, static_cast<uint16_t>(limit)));
  return hn::Eq(excess, hn::Zero(d));
}

/// The lanes of int32 values in [0, 2^31 - 2] that are <= limit, limit >= 0.
template <class D>
HWY_INLINE hn::Mask<D> at_most_i32(D d, hn::Vec<D> values, int64_t limit) {
  const int32_t clipped = static_cast<int32_t>(HWY_MIN(limit, int64_t{0x7FFFFFFE}));
  return hn::Lt(values, hn::Set(d, clipped + 1));
}

/// Whether any of the first `count` lanes is set.
template <class D>
HWY_INLINE bool any_candidate(D d, hn::Mask<D> mask, int count) {
  if (count >= static_cast<int>(hn::Lanes(d))) {
    return !hn::AllFalse(d, mask);
  }
  return !hn::AllFalse(d, hn::And(mask, hn::FirstN(d, static_cast<size_t>(count))));
}

/// Offers the group's candidates with the smallest sad: those with sign + if there is one, as they
/// precede the others, else those with sign -. No other can be the first of the group. `plus` and
/// `minus` hold the sads of both signs; `minus` counts if kBothSigns.
template <bool kBothSigns, class D>
HWY_INLINE void offer_least(D d, hn::Vec<D> plus, hn::Vec<D> minus, const MotionGroup& group,
                            MotionBest& best) {
  const auto inside = hn::FirstN(d, static_cast<size_t>(group.count));
  const auto none = hn::Set(d, hwy::LimitsMax<hn::TFromD<D>>());
  plus = hn::IfThenElse(inside, plus, none);
  minus = kBothSigns ? hn::IfThenElse(inside, minus, none) : none;
  const auto least = hn::MinOfLanes(d, hn::Min(plus, minus));
  const bool negative = hn::AllFalse(d, hn::Eq(plus, least));
  uint8_t bytes[8] = {};  // StoreMaskBits may write that many
  hn::StoreMaskBits(d, hn::Eq(negative ? minus : plus, least), bytes);
  uint32_t bits =
      bytes[0] | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
    best.offer({.dx = static_cast<int16_t>(group.dx + lane * group.step_x),
                .dy = static_cast<int16_t>(group.dy + lane * group.step_y),
                .negative = negative,
                .sad = static_cast<uint32_t>(hn::GetLane(least))});
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif  // HMLFC_MOTION_SEARCH_LANES_INL
