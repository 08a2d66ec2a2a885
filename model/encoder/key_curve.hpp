// Measures what a key image costs at different errors (KEY-2, EXT-6).
#pragma once

#include <functional>
#include <vector>

#include "decoder/jpeg2000.hpp"
#include "encoder/rate_distortion.hpp"

namespace hmlfc {

/// A plane of a key image, coded.
struct KeyPoint {
  double asked = 0;  ///< the mean squared error asked for
  double error = 0;  ///< the one reached
  double bits = 0;   ///< a sample
  int steps = 0;     ///< of its refinement
};

/// Mean squared errors that a key image leaves: in the view that it is coded for, and in images
/// that are predicted from it.
struct KeyErrors {
  double own = 0;
  double predicted = 0;
};

/// What the samples that a decoder makes of a key image leave.
using KeyMeasure = std::function<KeyErrors(const SamplePlane& decoded)>;

/// Of two planes of one size.
double mean_squared_error(const SamplePlane& a, const SamplePlane& b);

/// Bits against error of one plane in JPEG 2000, measured once at a few errors and interpolated
/// between them: the logarithm of the error falls about linearly with the bits.
class KeyCurve {
 public:
  /// An empty curve: cheapest() must not be called.
  KeyCurve() = default;

  /// Codes `plane`, refined in so many steps, about a dozen times. Throws std::bad_alloc.
  KeyCurve(const SamplePlane& plane, int steps, SamplePrecision precision,
           const KeyMeasure& measure);

  /// Where own error + weight * predicted error + lambda * bits is least, `weight` >= 0. `asked` is
  /// one of a fixed series, four for each doubling, so that the last digits of a machine's
  /// logarithms do not matter.
  KeyPoint cheapest(double weight, Lambda lambda) const { return least(weight, lambda).key; }
  /// The bits of a sample at the error `asked`.
  double bits(double asked) const;
  double cost(double weight, Lambda lambda) const { return least(weight, lambda).cost; }

 private:
  struct Measured {
    KeyPoint key;
    KeyErrors errors;
  };

  struct Priced {
    KeyPoint key;
    double cost;
  };

  Priced least(double weight, Lambda lambda) const;

  std::vector<Measured> points_;  // from fine to coarse
};

}  // namespace hmlfc
