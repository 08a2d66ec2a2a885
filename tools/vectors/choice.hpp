// How a recipe chooses the value of a field each time the field is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vectors/json.hpp"
#include "vectors/random.hpp"

namespace hmlfc::vectors {

/// A rule for one field. In a recipe it is
///   7                    always 7, in its interval or not
///   [2, 9]               uniform in [2, 9]
///   "random"             uniform in the field's whole interval
///   "min", "max"         the ends of the interval
///   "ramp"               lo, lo + 1, ... hi, lo, ...
///   {"of": [0, "max"]}   each in turn, then from the start again
class Choice {
 public:
  Choice() = default;  ///< "random"

  /// Throws TextError where `json` is none of the above.
  static Choice from(const Json& json);

  /// The next value of a field whose interval is [lo, hi] now, lo <= hi.
  ///
  /// Example: {"of": ["min", 3]} gives lo, 3, lo, 3, ...
  int64_t pick(int64_t lo, int64_t hi, Random& random);

 private:
  enum class Kind : uint8_t { kConstant, kInterval, kRandom, kMin, kMax, kRamp };
  struct Term {
    Kind kind = Kind::kRandom;
    int64_t first = 0;
    int64_t last = 0;
  };
  static Term term_from(const Json& json);

  std::vector<Term> terms_{Term{}};
  uint64_t picks_ = 0;
};

}  // namespace hmlfc::vectors
