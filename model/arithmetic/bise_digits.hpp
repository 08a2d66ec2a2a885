// Trit and quint groups: their codes and their digits (BISE-8, BISE-9, BISE-10).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hmlfc {

inline constexpr size_t kTritsInGroup = 5;
inline constexpr size_t kQuintsInGroup = 3;
inline constexpr unsigned kTritGroupBits = 8;
inline constexpr unsigned kQuintGroupBits = 7;

using Trits = std::array<uint8_t, kTritsInGroup>;    ///< t0 to t4, each in [0, 2]
using Quints = std::array<uint8_t, kQuintsInGroup>;  ///< q0 to q2, each in [0, 4]

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

/// The greatest code of the five trits, each in [0, 2]: the canonical one (BISE-10).
uint8_t canonical_trit_code(const Trits& trits);

/// The greatest code of the three quints, each in [0, 4]: the canonical one (BISE-10).
uint8_t canonical_quint_code(const Quints& quints);

}  // namespace hmlfc
