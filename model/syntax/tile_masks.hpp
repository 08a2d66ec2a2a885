// Order and masks of the blocks of a tile (TIL-2 to TIL-4).
#pragma once

#include <algorithm>
#include <cstdint>

#include "bits/bit_string.hpp"
#include "syntax/field_cursor.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

inline constexpr unsigned kQuadsInTile = 16;
inline constexpr unsigned kBlocksInQuad = 4;

/// Number of block (i, j) of a tile, i = column and j = row in [0, 7] (TIL-2).
///
/// Example: block (3, 2) is 4 * (4 * 1 + 1) + 2 * 0 + 1 = 21.
constexpr unsigned block_number(unsigned i, unsigned j) {
  return 4 * (4 * (j >> 1) + (i >> 1)) + 2 * (j & 1) + (i & 1);
}

/// Column and row of block k in [0, 63]: the inverse of block_number.
constexpr unsigned block_column(unsigned k) { return 2 * ((k >> 2) & 3) + (k & 1); }
constexpr unsigned block_row(unsigned k) { return 2 * (k >> 4) + ((k >> 1) & 1); }

/// The blocks of tile (tx, ty) that lie at least partly in the plane, as a mask.
constexpr uint64_t blocks_inside(const PlaneShape& plane, uint32_t tx, uint32_t ty) {
  const uint32_t columns = std::min(kTileBlocks, plane.blocks_x - tx * kTileBlocks);
  const uint32_t rows = std::min(kTileBlocks, plane.blocks_y - ty * kTileBlocks);
  uint64_t mask = 0;
  for (unsigned j = 0; j < rows; ++j) {
    for (unsigned i = 0; i < columns; ++i) mask |= uint64_t{1} << block_number(i, j);
  }
  return mask;
}

/// How a tile record says a mask (TIL-3).
enum MaskMode : uint32_t { kMaskNone = 0, kMaskAll = 1, kMaskRaw = 2, kMaskQuads = 3 };

/// The mode in which `mask` takes the fewest bits; `inside`: the blocks of the tile in the plane.
uint32_t mask_mode(uint64_t mask, uint64_t inside);

/// Reads the mask that `mode` in [0, 3] announces (TIL-3).
uint64_t read_mask(FieldCursor& cursor, uint32_t mode, uint64_t inside);

/// Bits of `mask` in `mode`.
unsigned mask_bits(uint64_t mask, uint32_t mode);

/// Appends `mask` in `mode`.
void put_mask(BitWriter& writer, uint64_t mask, uint32_t mode);

}  // namespace hmlfc
