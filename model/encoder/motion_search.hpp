// Phase-shifted motion search: the block of a reference plane, or of its negative, nearest to a
// given block.
#pragma once

#include <cstdint>
#include <span>

#include "encoder/padded_plane.hpp"

namespace hmlfc {

/// A candidate of a search: the reference block displaced by (dx, dy), as it is or negated.
struct MotionMatch {
  int16_t dx = 0;         ///< samples to the right, [-127, 127]
  int16_t dy = 0;         ///< samples down, [-127, 127]
  bool negative = false;  ///< prediction = -reference (the additive phase) if set
  uint32_t sad = 0;       ///< sum of absolute differences, [0, 64 * 32764]

  friend bool operator==(const MotionMatch&, const MotionMatch&) = default;
};

/// The total order of candidates that makes the result of a search unique. `a` precedes `b` if its
/// sad is smaller; then if only `b` is negated; then if |dx| + |dy| is smaller; then dy; then dx.
constexpr bool precedes(const MotionMatch& a, const MotionMatch& b) {
  if (a.sad != b.sad) {
    return a.sad < b.sad;
  }
  if (a.negative != b.negative) {
    return b.negative;
  }
  const int a_length = (a.dx < 0 ? -a.dx : a.dx) + (a.dy < 0 ? -a.dy : a.dy);
  const int b_length = (b.dx < 0 ? -b.dx : b.dx) + (b.dy < 0 ? -b.dy : b.dy);
  if (a_length != b_length) {
    return a_length < b_length;
  }
  return a.dy != b.dy ? a.dy < b.dy : a.dx < b.dx;
}

/// The first, in the order of precedes(), of all candidates (dx, dy) in [-window, window]^2, each
/// with both signs (only negative = false unless `both_signs`), where
///
///     sad = sum over i, j of |block[j * block_size + i] - s * reference(x + dx + i, y + dy + j)|
///
/// and s = -1 if negative, else +1 (paper section "Phase-shifted Motion Compensation").
///
/// `block`: block_size^2 samples, row-major, each in [-16382, 16382]. `block_size`: 2, 4 or 8.
/// `x` in [0, width - 1], `y` in [0, height - 1] of the reference: position of the block's top left
/// sample; the block may reach past the right and the bottom border, where the reference continues
/// with its nearest sample as on all other sides. `window`: [0, reference.max_window()].
/// `hints`: candidates worth trying first, such as the matches of neighbouring blocks; sad is not
/// read, a hint outside the window is ignored. Hints change the time taken and never the result.
///
/// Exact, and the same on every instruction set. Safe to call from many threads.
MotionMatch search_motion(std::span<const int16_t> block, int block_size, uint32_t x, uint32_t y,
                          const ReferencePlane& reference, int window, bool both_signs,
                          std::span<const MotionMatch> hints = {});

/// The definition of search_motion(): tries every candidate, in scalar code.
MotionMatch search_motion_brute_force(std::span<const int16_t> block, int block_size, uint32_t x,
                                      uint32_t y, const ReferencePlane& reference, int window,
                                      bool both_signs);

}  // namespace hmlfc
