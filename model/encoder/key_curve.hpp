// Measures what a key image costs at different errors (KEY-2, EXT-6).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "decoder/jpeg2000.hpp"
#include "encoder/rate_distortion.hpp"

namespace hmlfc {

/// A plane of a key image as it is coded, and what a decoder makes of it.
struct CodedPlane {
  std::vector<uint8_t> codestream;
  SamplePlane decoded;
};

/// Codes `plane` with a mean squared error of about `error`, which may be 0; with less where
/// OpenJPEG would leave far more, as it does of plain planes.
CodedPlane code_key_plane(const SamplePlane& plane, SamplePrecision precision, double error);

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
int64_t squared_error(const SamplePlane& a, const SamplePlane& b);
double mean_squared_error(const SamplePlane& a, const SamplePlane& b);

/// Bits against error of one plane in JPEG 2000, measured at a few errors and interpolated between
/// them: the logarithm of the error falls about linearly with the bits. What is asked for is
/// measured once. Not thread-safe.
class KeyCurve {
 public:
  /// Of `plane`, refined in so many steps. The other functions throw std::bad_alloc.
  KeyCurve(SamplePlane plane, int steps, SamplePrecision precision, KeyMeasure measure);

  /// Where own error + weight * predicted error + lambda * bits is least, `weight` >= 0, as far as
  /// there is one such place. `asked` is one of a fixed series, so that the last digits of a
  /// machine's logarithms do not matter.
  KeyPoint cheapest(double weight, Lambda lambda) const { return least(weight, lambda).key; }
  /// The bits of a sample at the error `asked`.
  double bits(double asked) const;
  double cost(double weight, Lambda lambda) const { return least(weight, lambda).cost; }

 private:
  struct Measured {
    KeyPoint key;
    KeyErrors errors;
  };

  struct Coded {
    std::vector<uint8_t> codestream;
    std::vector<double> bits;  // a sample, of its first layers
  };

  struct Priced {
    KeyPoint key;
    double cost;
  };

  Priced least(double weight, Lambda lambda) const;
  // The codestream that codes `point` and errors near to it.
  const Coded& coded(int point) const;
  double bits_at(int point) const;
  const Measured& measured(int point) const;

  SamplePlane plane_;
  int steps_;
  SamplePrecision precision_;
  int error_count_;
  KeyMeasure measure_;
  mutable std::map<int, Coded> coded_;
  mutable std::map<int, Measured> measured_;  // by number of the error, from fine to coarse
};

}  // namespace hmlfc
