// Bounded integer sequences (BISE-1 to BISE-11).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bits/bit_string.hpp"

namespace hmlfc {

/// The part of a value above its plain bits.
enum class Digit : uint8_t { kNone, kTrit, kQuint };

/// A level count N and how a value in [0, N - 1] splits: value = digit * 2^plain_bits + plain.
struct Levels {
  uint32_t count = 1;      ///< N
  uint8_t plain_bits = 0;  ///< n, [0, 12]
  Digit digit = Digit::kNone;

  friend bool operator==(const Levels&, const Levels&) = default;
};

/// Largest level code that a stream can hold: that of 16384 levels, for depth 12 (TIL-8).
inline constexpr unsigned kMaxLevelCode = 39;

/// Largest level code of residuals at `depth` in [8, 12]: that of 2^(depth + 2) levels (TIL-8).
constexpr unsigned max_residual_level_code(int depth) {
  return 27u + 3u * static_cast<unsigned>(depth - 8);
}

/// The levels of `code` in [0, kMaxLevelCode] by formula (BISE-1).
///
/// Example: code 7 gives 10 levels: a quint and 1 plain bit.
constexpr Levels levels_of_code(unsigned code) {
  assert(code <= kMaxLevelCode);
  if (code < 3) {
    constexpr std::array<Levels, 3> kFirst{
        {{1, 0, Digit::kNone}, {2, 1, Digit::kNone}, {3, 0, Digit::kTrit}}};
    return kFirst[code];
  }
  const unsigned e = (code - 3) / 3;
  switch ((code - 3) % 3) {
    case 0:
      return {4u << e, static_cast<uint8_t>(e + 2), Digit::kNone};
    case 1:
      return {5u << e, static_cast<uint8_t>(e), Digit::kQuint};
    default:
      return {6u << e, static_cast<uint8_t>(e + 1), Digit::kTrit};
  }
}

/// The smallest level code with at least `count` levels; count in [1, 16384].
///
/// Example: 33 levels need code 13, which has 40.
constexpr unsigned level_code_for(uint32_t count) {
  unsigned code = 0;
  while (levels_of_code(code).count < count) ++code;
  return code;
}

inline constexpr size_t kTritsPerGroup = 5;
inline constexpr size_t kQuintsPerGroup = 3;
inline constexpr unsigned kTritGroupBits = 8;
inline constexpr unsigned kQuintGroupBits = 7;

using Trits = std::array<uint8_t, kTritsPerGroup>;    ///< t0 to t4, each in [0, 2]
using Quints = std::array<uint8_t, kQuintsPerGroup>;  ///< q0 to q2, each in [0, 4]

/// Bits high down to low of x.
constexpr uint32_t bits_of(uint32_t x, unsigned high, unsigned low) {
  return (x >> low) & ((1u << (high - low + 1)) - 1u);
}

/// The trits of code T in [0, 255] (BISE-8).
constexpr Trits trits_of_code(uint32_t T) {
  uint32_t C = 0, t0 = 0, t1 = 0, t2 = 0, t3 = 0, t4 = 0;
  if (bits_of(T, 4, 2) == 7) {
    C = (bits_of(T, 7, 5) << 2) | bits_of(T, 1, 0);
    t4 = 2;
    t3 = 2;
  } else {
    C = bits_of(T, 4, 0);
    if (bits_of(T, 6, 5) == 3) {
      t4 = 2;
      t3 = bits_of(T, 7, 7);
    } else {
      t4 = bits_of(T, 7, 7);
      t3 = bits_of(T, 6, 5);
    }
  }
  if (bits_of(C, 1, 0) == 3) {
    t2 = 2;
    t1 = bits_of(C, 4, 4);
    t0 = (bits_of(C, 3, 3) << 1) | (bits_of(C, 2, 2) & ~bits_of(C, 3, 3) & 1u);
  } else if (bits_of(C, 3, 2) == 3) {
    t2 = 2;
    t1 = 2;
    t0 = bits_of(C, 1, 0);
  } else {
    t2 = bits_of(C, 4, 4);
    t1 = bits_of(C, 3, 2);
    t0 = (bits_of(C, 1, 1) << 1) | (bits_of(C, 0, 0) & ~bits_of(C, 1, 1) & 1u);
  }
  return {static_cast<uint8_t>(t0), static_cast<uint8_t>(t1), static_cast<uint8_t>(t2),
          static_cast<uint8_t>(t3), static_cast<uint8_t>(t4)};
}

/// The quints of code Q in [0, 127] (BISE-9).
constexpr Quints quints_of_code(uint32_t Q) {
  uint32_t C = 0, q0 = 0, q1 = 0, q2 = 0;
  if (bits_of(Q, 2, 1) == 3 && bits_of(Q, 6, 5) == 0) {
    const uint32_t not_q = ~bits_of(Q, 0, 0) & 1u;
    q2 = (bits_of(Q, 0, 0) << 2) | ((bits_of(Q, 4, 4) & not_q) << 1) | (bits_of(Q, 3, 3) & not_q);
    q1 = 4;
    q0 = 4;
  } else {
    if (bits_of(Q, 2, 1) == 3) {
      q2 = 4;
      C = (bits_of(Q, 4, 3) << 3) | ((~bits_of(Q, 6, 5) & 3u) << 1) | bits_of(Q, 0, 0);
    } else {
      q2 = bits_of(Q, 6, 5);
      C = bits_of(Q, 4, 0);
    }
    if (bits_of(C, 2, 0) == 5) {
      q1 = 4;
      q0 = bits_of(C, 4, 3);
    } else {
      q1 = bits_of(C, 4, 3);
      q0 = bits_of(C, 2, 0);
    }
  }
  return {static_cast<uint8_t>(q0), static_cast<uint8_t>(q1), static_cast<uint8_t>(q2)};
}

/// The canonical code of five trits, each in [0, 2]: the largest (BISE-10).
uint8_t canonical_trit_code(const Trits& trits);

/// The canonical code of three quints, each in [0, 4]: the largest (BISE-10).
uint8_t canonical_quint_code(const Quints& quints);

/// Bits [first, first + count) of T or Q, which follow the plain bits of one value of its digit
/// group (BISE-5, BISE-6).
struct DigitBits {
  uint8_t first;
  uint8_t count;
};

inline constexpr std::array<DigitBits, kTritsPerGroup> kTritLayout{
    {{0, 2}, {2, 2}, {4, 1}, {5, 2}, {7, 1}}};
inline constexpr std::array<DigitBits, kQuintsPerGroup> kQuintLayout{{{0, 3}, {3, 2}, {5, 2}}};

/// Bits of a sequence of `count` values (BISE-3); count in [0, 2^32 / 32].
///
/// Example: 16 values of 12 levels (trits, n = 2) take 32 + ceil(128 / 5) = 58 bits.
constexpr uint64_t bise_bits(const Levels& levels, uint64_t count) {
  const uint64_t plain = levels.plain_bits * count;
  switch (levels.digit) {
    case Digit::kTrit:
      return plain + (8 * count + 4) / 5;
    case Digit::kQuint:
      return plain + (7 * count + 2) / 3;
    case Digit::kNone:
      break;
  }
  return plain;
}

/// Value `i` in [0, count - 1] of the sequence of `count` values that begins at bit `start` of
/// `bits` (BISE-11). The sequence must be there: bits.holds(start, bise_bits(levels, count)).
/// Result in [0, levels.count - 1]. Every bit pattern is valid (BISE-10).
uint32_t bise_value(const BitString& bits, uint64_t start, const Levels& levels, uint64_t count,
                    uint64_t i);

/// Appends `values`, each in [0, levels.count - 1], in canonical form (BISE-10).
void bise_put(BitWriter& writer, const Levels& levels, std::span<const uint32_t> values);

/// Values of a digit group: 5 with trits, 3 with quints, 1 without digits.
size_t digit_group_size(const Levels& levels);

/// The canonical T or Q of each digit group of `values`, each in [0, levels.count - 1]; none
/// without digits.
std::vector<uint32_t> canonical_codes(const Levels& levels, std::span<const uint32_t> values);

/// Appends a sequence whose digits are given by `codes`, the T or Q of each digit group, none
/// without digits; of `values` only the plain bits count. The last code is cut by BISE-7.
void bise_put_codes(BitWriter& writer, const Levels& levels, std::span<const uint32_t> values,
                    std::span<const uint32_t> codes);

}  // namespace hmlfc
