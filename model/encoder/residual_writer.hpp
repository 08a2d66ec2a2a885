// How the residual blocks of a tile are written: parameters of the tile, then level code, bias and
// values of each block (TIL-8, TIL-9, STP-1).
#pragma once

#include <cstdint>
#include <span>

#include "arithmetic/rounding.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// Smallest and largest residual of one block; lo <= hi, both in [-M, M].
struct ResidualInterval {
  int32_t lo = 0;
  int32_t hi = 0;
};

/// Level code and bias with which every value of an interval can be written.
struct BlockCode {
  unsigned level_code = 0;
  int32_t bias = 0;
};

/// The value of a signed field of `bits` bits in [0, 14] that is nearest to `value`; 0 bits hold 0
/// alone.
constexpr int32_t nearest_signed(int32_t value, unsigned bits) {
  if (bits == 0) return 0;
  const int32_t half = int32_t{1} << (bits - 1);
  return clamp(value, -half, half - 1);
}

/// Whether such a field can hold `value`.
constexpr bool fits_signed(int32_t value, unsigned bits) {
  return nearest_signed(value, bits) == value;
}

/// The code of least size for `interval` whose bias fits in `bias_bits` bits in [0, 14]; of the
/// biases that do, the one nearest to 0. 0 bits allow bias 0 alone.
BlockCode least_code(const ResidualInterval& interval, unsigned bias_bits);

/// The fields of least size for `blocks`, at least one, with step 1; each value is in [-M, M].
ResidualFields residual_fields(std::span<const BlockValues> blocks, int depth);

}  // namespace hmlfc
