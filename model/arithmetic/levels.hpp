// Level codes of bounded integer sequences (BISE-1, BISE-2).
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

namespace hmlfc {

/// The part of a value above its plain bits.
enum class Digit : uint8_t { kNone, kTrit, kQuint };

/// A number of levels N and how a value in [0, N - 1] splits: value = digit * 2^plain_bits + plain.
struct Levels {
  uint32_t count = 1;      ///< N
  uint8_t plain_bits = 0;  ///< n, [0, 12]
  Digit digit = Digit::kNone;

  friend bool operator==(const Levels&, const Levels&) = default;
};

/// Greatest level code that any stream can hold: that of 16384 levels, for depth 12 (TIL-8).
inline constexpr unsigned kMaxLevelCode = 39;

/// Greatest level code of residuals at `depth` in [8, 12]: that of 2^(depth + 2) levels (TIL-8).
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

/// The least level code with at least `count` levels; count in [1, 16384].
///
/// Example: 33 levels need code 13, which has 40.
constexpr unsigned level_code_for(uint32_t count) {
  unsigned code = 0;
  while (levels_of_code(code).count < count) ++code;
  return code;
}

}  // namespace hmlfc
