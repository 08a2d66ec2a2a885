// The motion search without Highway: one candidate after another, each as long as it may be the
// best.
#include <algorithm>
#include <cstdlib>

#include "encoder/motion_search_request.hpp"

namespace hmlfc {

MotionMatch search_motion(std::span<const int16_t> block, int block_size, uint32_t x, uint32_t y,
                          const ReferencePlane& reference, int window, bool both_signs,
                          std::span<const MotionMatch> hints) {
  MotionBest best;
  const auto offer = [&](int dx, int dy, bool negative, int sad) {
    best.offer({.dx = static_cast<int16_t>(dx),
                .dy = static_cast<int16_t>(dy),
                .negative = negative,
                .sad = static_cast<uint32_t>(sad)});
  };
  const auto try_at = [&](int dx, int dy) {
    const int64_t limit = best.limit(std::abs(dx) + std::abs(dy));
    const int16_t* sample = block.data();
    const int16_t* candidate = reference.sample(int64_t{x} + dx, int64_t{y} + dy);
    int difference = 0;
    int sum = 0;
    for (int row = 0; row < block_size; ++row) {
      for (int col = 0; col < block_size; ++col) {
        difference += std::abs(sample[col] - candidate[col]);
        sum += std::abs(sample[col] + candidate[col]);
      }
      if ((both_signs ? std::min(difference, sum) : difference) > limit) return;
      sample += block_size;
      candidate += reference.stride();
    }
    offer(dx, dy, false, difference);
    if (both_signs) offer(dx, dy, true, sum);
  };
  for (const MotionMatch& hint : hints) {
    if (std::abs(hint.dx) <= window && std::abs(hint.dy) <= window) try_at(hint.dx, hint.dy);
  }
  for (int dy = -window; dy <= window; ++dy) {
    for (int dx = -window; dx <= window; ++dx) try_at(dx, dy);
  }
  return best.match();
}

}  // namespace hmlfc
