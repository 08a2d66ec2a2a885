// Measures what a key image costs at different errors (KEY-2, EXT-6).
#pragma once

#include <vector>

#include "decoder/jpeg2000.hpp"
#include "encoder/rate_distortion.hpp"

namespace hmlfc {

/// A plane of a key image, coded.
struct KeyPoint {
  double asked = 0;  ///< the mean squared error asked for
  double error = 0;  ///< the one reached
  double bits = 0;   ///< a sample
};

/// Bits against error of one plane in JPEG 2000, measured once at a few errors and interpolated
/// between them: the logarithm of the error falls about linearly with the bits.
class KeyCurve {
 public:
  /// An empty curve: cheapest() must not be called.
  KeyCurve() = default;

  /// Codes `plane` about a dozen times. Throws std::bad_alloc.
  KeyCurve(const SamplePlane& plane, SamplePrecision precision);

  /// Where weight * D + lambda * R is least, `weight` > 0. `asked` is one of a fixed series, four
  /// for each doubling, so that the last digits of a machine's logarithms do not matter.
  KeyPoint cheapest(double weight, Lambda lambda) const;

 private:
  std::vector<KeyPoint> points_;  // from fine to coarse
};

}  // namespace hmlfc
