// What a tile record says about one block (TIL-5, TIL-7 to TIL-9, STP-1).
#pragma once

#include <cstdint>

#include <hmlfc/error.hpp>

#include "syntax/field_cursor.hpp"
#include "syntax/tile_head.hpp"

namespace hmlfc {

/// The entry of one block. Vector fields have meaning with motion, residual fields with a residual.
struct BlockEntry {
  BlockState state = BlockState::kZero;
  bool negative = false;  ///< sign -
  int32_t dx = 0;         ///< [-window, window]
  int32_t dy = 0;
  Levels levels;           ///< of the block's values
  int32_t bias = 0;        ///< [-2^(depth + 1), 2^(depth + 1) - 1]
  int32_t step = 1;        ///< [1, 256] (STP-2)
  uint64_t values_at = 0;  ///< first bit of the block's values in the record

  bool has_motion() const {
    return state == BlockState::kMotion || state == BlockState::kMotionResidual;
  }
  bool has_residual() const {
    return state == BlockState::kResidual || state == BlockState::kMotionResidual;
  }
};

/// The entry of block `k` in [0, 63] of the record under `cursor`, whose head is `head`. At most 63
/// block headers are added up (BND-1). Afterwards the block's values lie within the record. Errors:
/// vector_range, bad_levels, tile_overrun.
Result<BlockEntry> read_block_entry(FieldCursor& cursor, const TileHead& head,
                                    const TileContext& context, unsigned k);

}  // namespace hmlfc
