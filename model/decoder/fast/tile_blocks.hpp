// The fast path's reader: all blocks of a tile at once, equal to walk_to_block on each.
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/error.hpp>

#include "decoder/sample_plane.hpp"
#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {

inline constexpr unsigned kBlocksInTile = kTileBlocks * kTileBlocks;

/// The entries and residuals of one tile, by block number (TIL-2).
struct TileBlocks {
  uint64_t motion_mask = 0;
  uint64_t residual_mask = 0;
  unsigned block_samples = 16;
  std::array<int8_t, kBlocksInTile> dx;      ///< with motion
  std::array<int8_t, kBlocksInTile> dy;      ///< with motion
  std::array<bool, kBlocksInTile> negative;  ///< with motion
  std::array<int16_t, size_t{kBlocksInTile} * kMaxBlockSize * kMaxBlockSize> values;

  /// The B * B residuals of block k, which has a residual and was wanted.
  const int16_t* residual(unsigned k) const { return values.data() + size_t{k} * block_samples; }
};

/// The blocks of `rect` in the tile whose first block is (bx, by), by block number.
inline uint64_t blocks_of_rect(const BlockRect& rect, uint32_t bx, uint32_t by) {
  // The number of block (i, j) is that of (i, 0) plus that of (0, j) (TIL-2).
  constexpr uint64_t kColumn = 0x0005'0005'0005'0005;
  constexpr uint64_t kRow = 0x3333;
  uint64_t columns = 0;
  uint64_t rows = 0;
  for (unsigned i = 0; i < kTileBlocks; ++i) {
    if (bx + i >= rect.bx0 && bx + i < rect.bx1) columns |= kColumn << block_number(i, 0);
    if (by + i >= rect.by0 && by + i < rect.by1) rows |= kRow << block_number(0, i);
  }
  return columns & rows;
}

/// Reads the tile that holds block `site`; values of residuals are unpacked for the blocks of
/// `wanted` alone. On failure some block of the tile does not decode, not necessarily a wanted one.
Result<void> read_tile_blocks(const StreamView& stream, const BlockSite& site, uint64_t wanted,
                              TileBlocks& blocks);

}  // namespace hmlfc
