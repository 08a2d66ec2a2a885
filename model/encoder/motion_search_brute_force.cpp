// The definition of the motion search.
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "encoder/motion_search.hpp"

namespace hmlfc {

MotionMatch search_motion_brute_force(std::span<const int16_t> block, int block_size, uint32_t x,
                                      uint32_t y, const ReferencePlane& reference, int window,
                                      bool both_signs) {
  MotionMatch best{.sad = std::numeric_limits<uint32_t>::max()};
  for (int dy = -window; dy <= window; ++dy) {
    for (int dx = -window; dx <= window; ++dx) {
      const int16_t* candidate = reference.sample(int64_t{x} + dx, int64_t{y} + dy);
      const int16_t* sample = block.data();
      int difference = 0;
      int sum = 0;
      for (int row = 0; row < block_size; ++row) {
        for (int col = 0; col < block_size; ++col) {
          difference += std::abs(sample[col] - candidate[col]);
          sum += std::abs(sample[col] + candidate[col]);
        }
        sample += block_size;
        candidate += reference.stride();
      }
      MotionMatch match{.dx = static_cast<int16_t>(dx),
                        .dy = static_cast<int16_t>(dy),
                        .negative = false,
                        .sad = static_cast<uint32_t>(difference)};
      if (precedes(match, best)) {
        best = match;
      }
      match.negative = true;
      match.sad = static_cast<uint32_t>(sum);
      if (both_signs && precedes(match, best)) {
        best = match;
      }
    }
  }
  return best;
}

}  // namespace hmlfc
