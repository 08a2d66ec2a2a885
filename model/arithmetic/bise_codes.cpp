#include "arithmetic/bise_codes.hpp"

#include <algorithm>
#include <array>

#include "arithmetic/bise.hpp"
#include "arithmetic/bise_group.hpp"

namespace hmlfc {
namespace {

// Writes one group of up to layout.size() values whose digits have the code `code`; only the digit
// bits of values that are there are written, which is where BISE-3 ends the sequence.
void put_group(BitWriter& writer, unsigned plain_bits, std::span<const uint32_t> values,
               std::span<const DigitBits> layout, uint32_t code, uint64_t end) {
  const uint32_t plain_mask = (1u << plain_bits) - 1u;
  for (size_t j = 0; j < values.size(); ++j) {
    writer.put(values[j] & plain_mask, plain_bits);
    const unsigned there =
        static_cast<unsigned>(std::min<uint64_t>(layout[j].count, end - writer.size()));
    writer.put(bits_of(code, layout[j].first + 7u, layout[j].first) & ((1u << there) - 1u), there);
  }
}

template <size_t kMembers>
std::array<uint8_t, kMembers> digits_of(std::span<const uint32_t> values, unsigned plain_bits) {
  std::array<uint8_t, kMembers> digits{};
  for (size_t j = 0; j < values.size(); ++j)
    digits[j] = static_cast<uint8_t>(values[j] >> plain_bits);
  return digits;
}

std::span<const uint32_t> group_at(std::span<const uint32_t> values, size_t at, size_t members) {
  return values.subspan(at, std::min(members, values.size() - at));
}

}  // namespace

size_t group_size(const Levels& levels) {
  if (levels.digit == Digit::kNone) return 1;
  return levels.digit == Digit::kTrit ? kTritsInGroup : kQuintsInGroup;
}

std::vector<uint32_t> canonical_codes(const Levels& levels, std::span<const uint32_t> values) {
  std::vector<uint32_t> codes;
  if (levels.digit == Digit::kNone) return codes;
  const unsigned n = levels.plain_bits;
  const size_t members = group_size(levels);
  for (size_t at = 0; at < values.size(); at += members) {
    const auto group = group_at(values, at, members);
    codes.push_back(levels.digit == Digit::kTrit
                        ? canonical_trit_code(digits_of<kTritsInGroup>(group, n))
                        : canonical_quint_code(digits_of<kQuintsInGroup>(group, n)));
  }
  return codes;
}

void bise_put_codes(BitWriter& writer, const Levels& levels, std::span<const uint32_t> values,
                    std::span<const uint32_t> codes) {
  const unsigned n = levels.plain_bits;
  if (levels.digit == Digit::kNone) {
    for (const uint32_t value : values) writer.put(value, n);
    return;
  }
  const uint64_t end = writer.size() + bise_bits(levels, values.size());
  const size_t members = group_size(levels);
  for (size_t g = 0; g < codes.size(); ++g) {
    const auto group = group_at(values, g * members, members);
    if (levels.digit == Digit::kTrit) {
      put_group(writer, n, group, kTritLayout, codes[g], end);
    } else {
      put_group(writer, n, group, kQuintLayout, codes[g], end);
    }
  }
}

}  // namespace hmlfc
