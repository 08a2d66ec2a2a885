// Candidates of the motion search in 16-bit lanes. Included once for each instruction set.
#if defined(HMLFC_MOTION_SEARCH_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_MOTION_SEARCH_KERNEL_INL
#undef HMLFC_MOTION_SEARCH_KERNEL_INL
#else
#define HMLFC_MOTION_SEARCH_KERNEL_INL
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

/// Evaluates lanes() candidates at once, one in each lane; finds those with a sad of at most 65534.
///
/// |b - r| and |b + r| of samples in [-16382, 16382] are at most 32764 and fit in int16; the sum of
/// two is at most 65528 and fits in uint16; these pairs are added with saturation. A lane is
/// therefore exact if it is below 65535, and 65535 stands for that or more.
///
/// The same over the 2x2 sums B of the block and R of the reference gives a lower bound: |B - R| is
/// at most the sum of |b - r| in that square (successive elimination). These sums and differences
/// may leave int16; what remains of them modulo 2^16 is never larger in magnitude, nor is a sum of
/// two such magnitudes modulo 2^16, so that the bound stays one.
template <int kSize, bool kBothSigns>
class MotionKernel {
  using D = hn::CappedTag<int16_t, ReferencePlane::kReadAhead>;
  using DU = hn::CappedTag<uint16_t, ReferencePlane::kReadAhead>;
  using V = hn::Vec<D>;
  using U = hn::Vec<DU>;

 public:
  static constexpr bool kHasBound = kSize > 2;   ///< for a 2x2 block it gains nothing
  static constexpr int64_t kLargestSad = 65534;  ///< candidates with a larger one are not offered

  explicit MotionKernel(const MotionRequest& request) {
    const int16_t* b = request.block;
    int16_t* sample = samples_;
    int16_t* square = squares_;
    for (int row = 0; row < kSize; ++row) {
      for (int col = 0; col < kSize; ++col) {
        sample = store_operand(b[col], sample);
        if (row % 2 == 0 && col % 2 == 0) {
          square = store_operand(b[col] + b[col + 1] + b[col + kSize] + b[col + kSize + 1], square);
        }
      }
      b += kSize;
    }
  }

  /// Candidates of one group, [1, 32].
  static int lanes() { return static_cast<int>(hn::Lanes(D())); }

  /// Whether one of the first `count` candidates from the 2x2 sums `r` on may have a sad of at most
  /// `limit` in [0, 65534], by the lower bound.
  HWY_INLINE bool may_reach(const int16_t* r, ptrdiff_t stride, int count, int64_t limit) const {
    const D d;
    const DU du;
    const int16_t* operand = squares_;
    U plus = hn::Zero(du);
    U minus = hn::Zero(du);
    for (int row = 0; row < kSize; row += 2) {
      for (int col = 0; col < kSize; col += 4) {
        add_pair(hn::LoadU(d, r + col), hn::LoadU(d, r + col + 2), operand, plus, minus);
        operand += 4 * hn::Lanes(d);
      }
      r += 2 * stride;
    }
    return any_candidate(du, at_most_u16(du, least(plus, minus), limit), count);
  }

  /// Offers the candidates of `group`, whose first lies at `r`, to `best`. The sample to the right
  /// of another is column_step elements further, 1 unless kColumns; the one below, row_step.
  template <bool kColumns>
  HWY_INLINE void evaluate(const int16_t* r, ptrdiff_t row_step, ptrdiff_t column_step,
                           const MotionGroup& group, MotionBest& best) const {
    const int64_t limit = HWY_MIN(best.limit(group.least_length), kLargestSad);
    if (limit < 0) {
      return;
    }
    const D d;
    const DU du;
    const ptrdiff_t next = kColumns ? column_step : 1;
    const int16_t* operand = samples_;
    U plus = hn::Zero(du);
    U minus = hn::Zero(du);
    for (int row = 0; row < kSize; ++row) {
      for (int col = 0; col < kSize; col += 2) {
        const V first = hn::LoadU(d, r + col * next);
        add_pair(first, hn::LoadU(d, r + (col + 1) * next), operand, plus, minus);
        operand += 4 * hn::Lanes(d);
      }
      r += row_step;
    }
    if (any_candidate(du, at_most_u16(du, least(plus, minus), limit), group.count)) {
      offer_least<kBothSigns>(du, plus, minus, group, best);
    }
  }

 private:
  // Stores the operand of one value b: a vector of b, a vector of 2b (modulo 2^16).
  static int16_t* store_operand(int b, int16_t* out) {
    const D d;
    const size_t lanes = hn::Lanes(d);
    hn::Store(hn::Set(d, static_cast<int16_t>(b)), d, out);
    hn::Store(hn::Set(d, static_cast<int16_t>(2 * b)), d, out + lanes);
    return out + 2 * lanes;
  }

  // Adds |r0 - b0| + |r1 - b1| to `plus` and |r0 + b0| + |r1 + b1| to `minus`; `operands` are those
  // of b0 and b1. r + b comes from (r - b) + 2b, exact modulo 2^16: that leaves compilers no reason
  // to load r, which is not aligned, a second time.
  static HWY_INLINE void add_pair(V r0, V r1, const int16_t* operands, U& plus, U& minus) {
    const D d;
    const size_t lanes = hn::Lanes(d);
    const V difference0 = hn::Sub(r0, hn::Load(d, operands));
    const V difference1 = hn::Sub(r1, hn::Load(d, operands + 2 * lanes));
    plus = hn::SaturatedAdd(plus, magnitudes(difference0, difference1));
    if (kBothSigns) {
      const V sum0 = hn::Add(difference0, hn::Load(d, operands + lanes));
      const V sum1 = hn::Add(difference1, hn::Load(d, operands + 3 * lanes));
      minus = hn::SaturatedAdd(minus, magnitudes(sum0, sum1));
    }
  }

  static HWY_INLINE U magnitudes(V first, V second) {
    return hn::BitCast(DU(), hn::Add(hn::Abs(first), hn::Abs(second)));
  }

  static HWY_INLINE U least(U plus, U minus) { return kBothSigns ? hn::Min(plus, minus) : plus; }

  // Operands of the samples and of the 2x2 sums of the block, each row-major.
  static constexpr size_t kSamples = size_t{kSize} * kSize;
  HWY_ALIGN int16_t samples_[kSamples * 2 * ReferencePlane::kReadAhead];
  HWY_ALIGN int16_t squares_[kSamples / 4 * 2 * ReferencePlane::kReadAhead];
};

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif  // HMLFC_MOTION_SEARCH_KERNEL_INL
