// How the residual blocks of a tile are coded: common parameters, then level code and bias of each
// (TIL-8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

/// The code of least size for `interval` whose bias fits in `bias_bits` bits in [0, 14]; of the
/// biases that do, the one nearest to 0. 0 bits allow bias 0 alone.
BlockCode least_code(const ResidualInterval& interval, unsigned bias_bits);

/// Parameters and block codes of one tile.
struct ResidualCoding {
  unsigned level_base = 0;
  unsigned level_bits = 0;
  unsigned bias_bits = 0;
  std::vector<BlockCode> blocks;  ///< level codes in [level_base, level_base + 2^level_bits - 1]
  uint64_t bits = 0;              ///< of headers and values of all blocks
};

/// The coding of least size for the blocks of a tile, at least one, of `block_samples` values each,
/// at `depth` in [8, 12]. Exhaustive over bias_bits and level_bits; ties go to fewer bits of each.
ResidualCoding best_coding(std::span<const ResidualInterval> blocks, uint64_t block_samples,
                           int depth);

}  // namespace hmlfc
