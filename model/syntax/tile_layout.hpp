// Order and masks of the blocks of a tile (TIL-2, TIL-3), and widths that follow from the window
// (TIL-6).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "arithmetic/levels.hpp"
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

/// Widths of the fields of a tile's vectors (TIL-6).
struct VectorWidths {
  unsigned component_bits;  ///< v
  unsigned max_code;        ///< K
  unsigned code_bits;       ///< c
};

/// The widths for `window` in [0, 127].
///
/// Example: window 16 gives {6, 13, 4}: 33 values, level code 13 with 40 levels.
constexpr VectorWidths vector_widths(int window) {
  const uint32_t values = 2 * static_cast<uint32_t>(window) + 1;
  const unsigned max_code = level_code_for(values);
  return {static_cast<unsigned>(std::bit_width(values - 1)), max_code,
          static_cast<unsigned>(std::bit_width(max_code))};
}

}  // namespace hmlfc
