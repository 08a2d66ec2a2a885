// Population count and rank of 64-bit masks (CNV-6).
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>

namespace hmlfc {

/// Whether bit i in [0, 63] of `mask` is 1.
constexpr bool has_bit(uint64_t mask, unsigned i) { return ((mask >> i) & 1u) != 0; }

/// Number of 1 bits of `mask` below bit i in [0, 63].
///
/// Example: rank(0b1011, 2) = 2.
constexpr unsigned rank(uint64_t mask, unsigned i) {
  return static_cast<unsigned>(std::popcount(mask & ((uint64_t{1} << i) - 1)));
}

}  // namespace hmlfc
