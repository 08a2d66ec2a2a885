#include "decoder/fast/bise_unpack.hpp"

#include <algorithm>
#include <array>

#include "arithmetic/bise.hpp"
#include "bits/little_endian.hpp"

namespace hmlfc {
namespace {

constexpr auto make_trit_table() {
  std::array<Trits, 256> table{};
  for (uint32_t T = 0; T < 256; ++T) table[T] = trits_of_code(T);
  return table;
}

constexpr auto make_quint_table() {
  std::array<Quints, 128> table{};
  for (uint32_t Q = 0; Q < 128; ++Q) table[Q] = quints_of_code(Q);
  return table;
}

constexpr auto kTritTable = make_trit_table();
constexpr auto kQuintTable = make_quint_table();

// Up to 24 bits at bit `at`.
uint32_t peek(const uint8_t* bytes, uint64_t at, unsigned count) {
  return (load_le<uint32_t>({bytes + (at >> 3), 4}, 0) >> (at & 7)) & ((1u << count) - 1u);
}

// Reads whole and cut digit groups: of each value its plain bits and the digit bits that follow.
template <size_t kMembers, class Table>
void unpack_digits(const uint8_t* bytes, uint64_t start, unsigned n, uint64_t end, size_t count,
                   const std::array<DigitBits, kMembers>& layout, const Table& table,
                   uint16_t* out) {
  uint64_t at = start;
  for (size_t first = 0; first < count; first += kMembers) {
    const size_t members = std::min(kMembers, count - first);
    std::array<uint32_t, kMembers> plain{};
    uint32_t code = 0;
    for (size_t j = 0; j < members; ++j) {
      plain[j] = peek(bytes, at, n);
      at += n;
      const unsigned there = static_cast<unsigned>(std::min<uint64_t>(layout[j].count, end - at));
      code |= peek(bytes, at, there) << layout[j].first;
      at += there;
    }
    for (size_t j = 0; j < members; ++j) {
      out[first + j] = static_cast<uint16_t>((uint32_t{table[code][j]} << n) | plain[j]);
    }
  }
}

}  // namespace

void bise_unpack(const uint8_t* bytes, uint64_t start, const Levels& levels, size_t count,
                 uint16_t* out) {
  const unsigned n = levels.plain_bits;
  const uint64_t end = start + bise_bits(levels, count);
  switch (levels.digit) {
    case Digit::kTrit:
      return unpack_digits(bytes, start, n, end, count, kTritLayout, kTritTable, out);
    case Digit::kQuint:
      return unpack_digits(bytes, start, n, end, count, kQuintLayout, kQuintTable, out);
    case Digit::kNone:
      for (size_t i = 0; i < count; ++i) {
        out[i] = static_cast<uint16_t>(peek(bytes, start + i * n, n));
      }
  }
}

}  // namespace hmlfc
