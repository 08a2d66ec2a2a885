// Where the digit bits of a group stand (BISE-5, BISE-6).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "arithmetic/bise_digits.hpp"

namespace hmlfc {

/// Bits [first, first + count) of T or Q, which follow the plain bits of one value of the group.
struct DigitBits {
  uint8_t first;
  uint8_t count;
};

inline constexpr std::array<DigitBits, kTritsInGroup> kTritLayout{
    {{0, 2}, {2, 2}, {4, 1}, {5, 2}, {7, 1}}};
inline constexpr std::array<DigitBits, kQuintsInGroup> kQuintLayout{{{0, 3}, {3, 2}, {5, 2}}};

}  // namespace hmlfc
