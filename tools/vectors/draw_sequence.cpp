#include "vectors/draw_sequence.hpp"

#include <algorithm>
#include <string>

#include "arithmetic/bise.hpp"
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

void draw_tail_code(FieldRules& rules, SequenceFields& sequence, Random& random) {
  const Levels levels = levels_of_code(sequence.level_code);
  const size_t groups = code_count(levels, sequence.values.size());
  if (!rules.has("tail_code") || sequence.values.size() % digit_group_size(levels) == 0) return;
  if (sequence.codes.empty()) sequence.codes = canonical_codes(levels, sequence.values);
  const unsigned bits = code_bits(levels, sequence.values.size(), groups - 1);
  sequence.codes.back() = rules.pick_unsigned("tail_code", 0, (1u << bits) - 1, random);
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
  const size_t members = digit_group_size(levels);
  return (count + members - 1) / members;
}

unsigned code_bits(const Levels& levels, size_t count, size_t group) {
  const size_t members = std::min(digit_group_size(levels), count - group * digit_group_size(levels));
  return static_cast<unsigned>(bise_bits(levels, members) - levels.plain_bits * members);
}

}  // namespace hmlfc::vectors
