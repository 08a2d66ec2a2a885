// The rules by which a recipe sets the values of fields (vectors/README.md, fields).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
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
///   {"of": [0, "max"]}   each in turn, then from the start again; {"run": [9, 0]} among them is
///                        the same as 0 nine times
class FieldRule {
 public:
  FieldRule() = default;  ///< "random"

  /// Throws TextError where `json` is none of the above.
  static FieldRule from(const Json& json);

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

/// One rule per field, by its name in the specification if it has one. A field without a rule is
/// uniform in its whole interval, so that the default rules reach all syntax.
class FieldRules {
 public:
  FieldRules() = default;

  /// Throws TextError for a name that is no field.
  explicit FieldRules(const Json& json);

  /// The next value of `field`, whose interval is [lo, hi] now.
  int64_t pick(const std::string& field, int64_t lo, int64_t hi, Random& random);

  /// The same for a field of at most 32 bits.
  uint32_t pick_unsigned(const std::string& field, uint64_t lo, uint64_t hi, Random& random) {
    const auto value = pick(field, static_cast<int64_t>(lo), static_cast<int64_t>(hi), random);
    return static_cast<uint32_t>(value);
  }

  /// True in `percent` of 100 cases, by the rule of `density`, a number.
  bool present(const std::string& density, Random& random);

  /// Some of the blocks `inside`, by the rule of `mask`: one of "none", "all", "half", "few",
  /// "checker", "quads", "first" and "last", or several in turn.
  uint64_t pick_mask(const std::string& mask, uint64_t inside, Random& random);

  bool has(const std::string& field) const { return rules_.contains(field); }

 private:
  std::map<std::string, FieldRule> rules_;
};

}  // namespace hmlfc::vectors
