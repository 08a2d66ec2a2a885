#include "vectors/draw_sequence.hpp"

#include <algorithm>
#include <string>

#include "values/bise.hpp"
#include "values/bise_codes.hpp"
#include "values/bise_digits.hpp"
#include "vectors/json.hpp"

namespace hmlfc::vectors {

std::vector<uint32_t> least_codes(const Levels& levels, std::span<const uint32_t> values) {
  std::vector<uint32_t> codes = canonical_codes(levels, values);
  for (uint32_t& code : codes) {
    uint32_t least = 0;
    if (levels.digit == Digit::kTrit) {
      while (trits_of_code(least) != trits_of_code(code)) ++least;
    } else {
      while (quints_of_code(least) != quints_of_code(code)) ++least;
    }
    code = least;
  }
  return codes;
}

void require_representable(const SequenceFields& sequence) {
  const uint32_t levels = levels_of_code(sequence.level_code).count;
  for (const uint32_t value : sequence.values) {
    if (value < levels) continue;
    throw TextError("a rule gives value " + std::to_string(static_cast<int32_t>(value)) +
                    " of a sequence of " + std::to_string(levels) + " levels");
  }
}

size_t code_count(const Levels& levels, size_t count) {
  if (levels.digit == Digit::kNone) return 0;
  const size_t members = group_size(levels);
  return (count + members - 1) / members;
}

unsigned code_bits(const Levels& levels, size_t count, size_t group) {
  const size_t members = std::min(group_size(levels), count - group * group_size(levels));
  return static_cast<unsigned>(bise_bits(levels, members) - levels.plain_bits * members);
}

}  // namespace hmlfc::vectors
