#include "arithmetic/bise.hpp"

#include <algorithm>

namespace hmlfc {
namespace {

constexpr size_t index_of(const Trits& t) {
  return t[0] + 3u * (t[1] + 3u * (t[2] + 3u * (t[3] + 3u * t[4])));
}

constexpr size_t index_of(const Quints& q) { return q[0] + 5u * (q[1] + 5u * q[2]); }

// Codes are entered in ascending order, so that the largest code of each tuple stays.
constexpr std::array<uint8_t, 243> make_trit_codes() {
  std::array<uint8_t, 243> codes{};
  for (uint32_t T = 0; T < 256; ++T) codes[index_of(trits_of_code(T))] = static_cast<uint8_t>(T);
  return codes;
}

constexpr std::array<uint8_t, 125> make_quint_codes() {
  std::array<uint8_t, 125> codes{};
  for (uint32_t Q = 0; Q < 128; ++Q) codes[index_of(quints_of_code(Q))] = static_cast<uint8_t>(Q);
  return codes;
}

constexpr auto kTritCodes = make_trit_codes();
constexpr auto kQuintCodes = make_quint_codes();

std::span<const DigitBits> layout_of(Digit digit) {
  if (digit == Digit::kTrit) return kTritLayout;
  return kQuintLayout;
}

// The code T or Q of the digit group at bit `start`; bits at or past `end` are 0 (BISE-7).
uint32_t read_code(const BitString& bits, uint64_t start, uint64_t end, const Levels& levels) {
  uint32_t code = 0;
  uint64_t at = start;
  for (const DigitBits& digit : layout_of(levels.digit)) {
    at += levels.plain_bits;
    if (at >= end) break;
    const unsigned there = static_cast<unsigned>(std::min<uint64_t>(digit.count, end - at));
    code |= bits.field(at, there) << digit.first;
    at += digit.count;
  }
  return code;
}

template <size_t kMembers>
std::array<uint8_t, kMembers> digits_of(std::span<const uint32_t> values, unsigned plain_bits) {
  std::array<uint8_t, kMembers> digits{};
  for (size_t j = 0; j < values.size(); ++j) {
    digits[j] = static_cast<uint8_t>(values[j] >> plain_bits);
  }
  return digits;
}

std::span<const uint32_t> group_at(std::span<const uint32_t> values, size_t at, size_t members) {
  return values.subspan(at, std::min(members, values.size() - at));
}

}  // namespace

uint8_t canonical_trit_code(const Trits& trits) { return kTritCodes[index_of(trits)]; }

uint8_t canonical_quint_code(const Quints& quints) { return kQuintCodes[index_of(quints)]; }

uint32_t bise_value(const BitString& bits, uint64_t start, const Levels& levels, uint64_t count,
                    uint64_t i) {
  const unsigned n = levels.plain_bits;
  if (levels.digit == Digit::kNone) return bits.field(start + i * n, n);

  const bool trit = levels.digit == Digit::kTrit;
  const auto layout = layout_of(levels.digit);
  const uint64_t group_bits = layout.size() * n + (trit ? kTritGroupBits : kQuintGroupBits);
  const uint64_t group = start + (i / layout.size()) * group_bits;
  const auto member = static_cast<size_t>(i % layout.size());

  const uint32_t plain = bits.field(group + member * n + layout[member].first, n);
  const uint32_t code = read_code(bits, group, start + bise_bits(levels, count), levels);
  const uint32_t digit = trit ? trits_of_code(code)[member] : quints_of_code(code)[member];
  return (digit << n) | plain;
}

void bise_put(BitWriter& writer, const Levels& levels, std::span<const uint32_t> values) {
  bise_put_codes(writer, levels, values, canonical_codes(levels, values));
}

size_t digit_group_size(const Levels& levels) {
  return levels.digit == Digit::kNone ? 1 : layout_of(levels.digit).size();
}

std::vector<uint32_t> canonical_codes(const Levels& levels, std::span<const uint32_t> values) {
  std::vector<uint32_t> codes;
  if (levels.digit == Digit::kNone) return codes;
  const unsigned n = levels.plain_bits;
  const size_t members = digit_group_size(levels);
  for (size_t at = 0; at < values.size(); at += members) {
    const auto group = group_at(values, at, members);
    codes.push_back(levels.digit == Digit::kTrit
                        ? canonical_trit_code(digits_of<kTritsPerGroup>(group, n))
                        : canonical_quint_code(digits_of<kQuintsPerGroup>(group, n)));
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
  const uint32_t plain_mask = (1u << n) - 1u;
  const uint64_t end = writer.size() + bise_bits(levels, values.size());
  const auto layout = layout_of(levels.digit);
  for (size_t i = 0; i < values.size(); ++i) {
    const DigitBits digit = layout[i % layout.size()];
    writer.put(values[i] & plain_mask, n);
    const unsigned there =
        static_cast<unsigned>(std::min<uint64_t>(digit.count, end - writer.size()));
    writer.put((codes[i / layout.size()] >> digit.first) & ((1u << there) - 1u), there);
  }
}

}  // namespace hmlfc
