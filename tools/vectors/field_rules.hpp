// The rules of a recipe for every field of a stream (vectors/README.md, fields).
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "vectors/choice.hpp"

namespace hmlfc::vectors {

/// One choice for each field, by its name in the specification where it has one. A field without a
/// rule is uniform in its whole interval, so that the default rules reach all syntax.
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

  /// Some of the blocks `inside`: by the rule of `mask`, a word of "none", "all", "half", "few",
  /// "checker", "quads", "first" and "last", or several in turn.
  uint64_t pick_mask(const std::string& mask, uint64_t inside, Random& random);

  bool has(const std::string& field) const { return choices_.contains(field); }

 private:
  std::map<std::string, Choice> choices_;
};

}  // namespace hmlfc::vectors
