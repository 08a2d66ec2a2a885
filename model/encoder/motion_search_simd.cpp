// The fast motion search, compiled once for each instruction set and chosen at run time.
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoder/motion_search_simd.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

#include "encoder/motion_search_request.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One search: the window cut into groups of candidates, as many as a vector has lanes.
///
/// |b - r| and |b + r| of samples in [-16382, 16382] fit in int16; they are added as uint16 with
/// saturation. A lane is therefore exact if it is below 65535, which stands for that or more.
template <bool kBothSigns>
class MotionSearch {
  using D = hn::CappedTag<int16_t, ReferencePlane::kReadAhead>;
  using DU = hn::RebindToUnsigned<D>;

 public:
  explicit MotionSearch(const MotionRequest& request) : request_(request) {}

  /// Tries (0, 0), the hints, then all candidates. Not found(): each has a sad above kLargestSad.
  MotionBest run() {
    const int window = request_.window;
    try_around(0, 0);
    for (size_t k = 0; k < request_.hint_count; ++k) {
      try_around(request_.hints[k].dx, request_.hints[k].dy);
    }
    for (int k = 0; k <= 2 * window; ++k) {  // from the middle outwards: 0, 1, -1, 2, -2 ...
      const int dy = k % 2 != 0 ? (k + 1) / 2 : -(k / 2);
      for (int dx = -window; dx <= window; dx += lanes_) try_group(dx, dy);
    }
    return best_;
  }

 private:
  static constexpr int64_t kLargestSad = 65534;  // candidates with a larger one are not offered

  // Tries (dx, dy), if it lies in the window, and some of its neighbours to the left and the right.
  void try_around(int dx, int dy) {
    const int window = request_.window;
    if (dx < -window || dx > window || dy < -window || dy > window) return;
    const int last = HWY_MAX(-window, window + 1 - lanes_);
    try_group(HWY_MAX(-window, HWY_MIN(dx - lanes_ / 2, last)), dy);
  }

  // The candidates (dx, dy), (dx + 1, dy) ... in the window, until all are too bad.
  HWY_INLINE void try_group(int dx, int dy) {
    const int64_t limit = HWY_MIN(best_.limit(dy < 0 ? -dy : dy), kLargestSad);
    if (limit < 0) return;
    const D d;
    const DU du;
    const auto most = hn::Set(du, static_cast<uint16_t>(limit));
    auto plus = hn::Zero(du);
    auto minus = hn::Set(du, static_cast<uint16_t>(kBothSigns ? 0 : kLargestSad + 1));
    const int16_t* r = request_.reference + dy * request_.stride + dx;
    const int16_t* b = request_.block;
    for (int row = 0; row < request_.block_size; ++row, r += request_.stride) {
      for (int col = 0; col < request_.block_size; ++col, ++b) {
        const auto reference = hn::LoadU(d, r + col);
        const auto block = hn::Set(d, *b);
        plus = hn::SaturatedAdd(plus, hn::BitCast(du, hn::Abs(hn::Sub(reference, block))));
        if (!kBothSigns) continue;
        minus = hn::SaturatedAdd(minus, hn::BitCast(du, hn::Abs(hn::Add(reference, block))));
      }
      const auto excess = hn::SaturatedSub(hn::Min(plus, minus), most);
      if (hn::AllFalse(du, hn::Eq(excess, hn::Zero(du)))) return;
    }
    uint16_t sads[2][ReferencePlane::kReadAhead];
    hn::StoreU(plus, du, sads[0]);
    hn::StoreU(minus, du, sads[1]);
    for (int i = 0; i < HWY_MIN(lanes_, request_.window - dx + 1); ++i) {
      for (int sign = 0; sign < 2; ++sign) {
        if (sads[sign][i] > limit) continue;
        best_.offer({.dx = static_cast<int16_t>(dx + i),
                     .dy = static_cast<int16_t>(dy),
                     .negative = sign == 1,
                     .sad = sads[sign][i]});
      }
    }
  }

  const MotionRequest& request_;
  MotionBest best_;
  const int lanes_ = static_cast<int>(hn::Lanes(D()));
};

MotionBest search_request(const MotionRequest& request) {
  return request.both_signs ? MotionSearch<true>(request).run()
                            : MotionSearch<false>(request).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(search_request);

MotionMatch search_motion(std::span<const int16_t> block, int block_size, uint32_t x, uint32_t y,
                          const ReferencePlane& reference, int window, bool both_signs,
                          std::span<const MotionMatch> hints) {
  assert(block_size == 2 || block_size == 4 || block_size == 8);
  assert(block.size() == static_cast<size_t>(block_size * block_size));
  assert(x < reference.width() && y < reference.height());
  assert(window >= 0 && window <= reference.max_window());
  const MotionBest best = HWY_DYNAMIC_DISPATCH(search_request)({
      .block = block.data(),
      .reference = reference.sample(x, y),
      .stride = reference.stride(),
      .block_size = block_size,
      .window = window,
      .both_signs = both_signs,
      .hints = hints.data(),
      .hint_count = hints.size(),
  });
  if (best.found()) return best.match();
  // Nothing in the window resembles the block, whose samples have more than 8 bits.
  return search_motion_brute_force(block, block_size, x, y, reference, window, both_signs);
}

}  // namespace hmlfc

#endif  // HWY_ONCE
