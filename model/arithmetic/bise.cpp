#include "arithmetic/bise.hpp"

#include <algorithm>

#include "arithmetic/bise_codes.hpp"
#include "arithmetic/bise_group.hpp"

namespace hmlfc {
namespace {

// The code T or Q of the group at bit `start`; bits at or past `end` are 0 (BISE-7).
uint32_t group_code(const BitString& bits, uint64_t start, uint64_t end, unsigned plain_bits,
                    std::span<const DigitBits> layout) {
  uint32_t code = 0;
  uint64_t at = start;
  for (const DigitBits& digit : layout) {
    at += plain_bits;
    if (at >= end) break;
    const unsigned there = static_cast<unsigned>(std::min<uint64_t>(digit.count, end - at));
    code |= bits.field(at, there) << digit.first;
    at += digit.count;
  }
  return code;
}

uint32_t digit_of(const BitString& bits, uint64_t group, uint64_t end, const Levels& levels,
                  size_t member) {
  if (levels.digit == Digit::kTrit) {
    return trits_of_code(group_code(bits, group, end, levels.plain_bits, kTritLayout))[member];
  }
  return quints_of_code(group_code(bits, group, end, levels.plain_bits, kQuintLayout))[member];
}

}  // namespace

uint32_t bise_value(const BitString& bits, uint64_t start, const Levels& levels, uint64_t count,
                    uint64_t i) {
  const unsigned n = levels.plain_bits;
  if (levels.digit == Digit::kNone) return bits.field(start + i * n, n);

  const bool trit = levels.digit == Digit::kTrit;
  const uint64_t members = trit ? kTritsInGroup : kQuintsInGroup;
  const uint64_t group_bits = members * n + (trit ? kTritGroupBits : kQuintGroupBits);
  const uint64_t group = start + (i / members) * group_bits;
  const size_t member = static_cast<size_t>(i % members);
  const unsigned digits_before = trit ? kTritLayout[member].first : kQuintLayout[member].first;

  const uint64_t end = start + bise_bits(levels, count);
  const uint32_t plain = bits.field(group + member * n + digits_before, n);
  return (digit_of(bits, group, end, levels, member) << n) | plain;
}

void bise_put(BitWriter& writer, const Levels& levels, std::span<const uint32_t> values) {
  bise_put_codes(writer, levels, values, canonical_codes(levels, values));
}

}  // namespace hmlfc
