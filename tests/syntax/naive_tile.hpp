// Tile records written field by field from the table of TIL-1 and STP-1.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "bits/naive_bits.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc::test {

/// One block as it should be read back.
struct BlockModel {
  bool motion = false;
  bool negative = false;
  int dx = 0;
  int dy = 0;
  bool residual = false;
  unsigned level_code = 0;
  int bias = 0;
  std::vector<uint32_t> values{};  ///< B * B
  unsigned step_code = 0;          ///< STP-1
};

/// One tile. The fields need not lie in their intervals; they are written as they are.
struct TileModel {
  TileContext context;
  unsigned motion_mode = 0;
  unsigned residual_mode = 0;
  unsigned sign_mode = 0;
  int min_x = 0;
  int min_y = 0;
  unsigned codes_x = 0;
  unsigned codes_y = 0;
  unsigned level_base = 0;
  unsigned level_bits = 0;
  unsigned bias_bits = 0;
  unsigned step_base = 0;
  unsigned step_bits = 0;
  std::array<BlockModel, 64> blocks;

  uint64_t motion_mask() const;
  uint64_t residual_mask() const;
};

/// The bits of a record and where its parts end.
struct TileRecord {
  NaiveBits bits;
  size_t vectors_begin = 0;       ///< bit of sign_mode, or where it would stand
  size_t residuals_begin = 0;     ///< bit of level_base, or where it would stand
  size_t head_end = 0;            ///< after the last block header
  std::array<size_t, 64> ends{};  ///< of block k's values
};

/// Writes `tile` in the order of TIL-1, canonical BISE included.
TileRecord write_tile(const TileModel& tile);

/// A valid tile of random content: any mask and sign mode, block states and bounds.
TileModel draw_tile(std::mt19937& random, const TileContext& context);

/// A random context with a random set of blocks inside, that of some border tile.
TileContext draw_context(std::mt19937& random);

/// A number in [lo, hi].
int draw(std::mt19937& random, int lo, int hi);

}  // namespace hmlfc::test
