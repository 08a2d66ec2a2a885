// search_motion by its definition, for bench_skipping_exhaustive: an hmlfc whose encoder tries
// every candidate. The linker takes these functions in place of those of the library.
#include "encoder/motion_search.hpp"

namespace hmlfc {

MotionMatch search_motion(std::span<const int16_t> block, int block_size, uint32_t x, uint32_t y,
                          const ReferencePlane& reference, int window, bool both_signs,
                          std::span<const MotionMatch> /*hints*/) {
  return search_motion_brute_force(block, block_size, x, y, reference, window, both_signs);
}

const char* motion_search_instruction_set() { return "none"; }

}  // namespace hmlfc
