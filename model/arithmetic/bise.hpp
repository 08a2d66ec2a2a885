// Bounded integer sequences: size, reading one value, writing a sequence (BISE-3 to BISE-11).
#pragma once

#include <cstdint>
#include <span>

#include "arithmetic/levels.hpp"
#include "bits/bit_string.hpp"
#include "bits/bit_writer.hpp"

namespace hmlfc {

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

}  // namespace hmlfc
