// The head of a tile record: everything before its block headers (TIL-1, TIL-3, TIL-6, TIL-8,
// STP-1).
#pragma once

#include <cstdint>

#include <hmlfc/error.hpp>

#include "arithmetic/levels.hpp"
#include "syntax/field_cursor.hpp"
#include "syntax/tile_layout.hpp"

namespace hmlfc {

/// What a tile's place in the tree says about its record.
struct TileContext {
  /// Whether the record has motion fields: that of a predictive image, without motion tiles (TIL-1,
  /// MOT-2).
  bool predictive = false;
  uint64_t blocks_inside = ~uint64_t{0};
  int window = 0;               ///< [0, 127]
  int depth = 8;                ///< [8, 12]
  uint64_t block_samples = 16;  ///< B * B
  bool steps = false;           ///< whether the record has step fields (STP-1)
};

/// Vectors of a tile, if motion_mask is not 0. Positions are bits from the start of the record.
struct TileVectors {
  unsigned sign_mode = 0;  ///< [0, 2]
  int32_t min_x = 0;       ///< [-window, window]
  int32_t min_y = 0;
  Levels levels_x;
  Levels levels_y;
  uint64_t signs_at = 0;
  uint64_t x_at = 0;
  uint64_t y_at = 0;
};

/// Residuals of a tile, if residual_mask is not 0.
struct TileResiduals {
  unsigned level_base = 0;  ///< [0, 63]
  unsigned level_bits = 0;  ///< [0, 6]
  unsigned bias_bits = 0;   ///< [0, depth + 2]
  unsigned step_base = 0;   ///< [0, 15]
  unsigned step_bits = 0;   ///< [0, 3]
  uint64_t headers_at = 0;
  uint64_t values_at = 0;

  /// Bits of one block header (TIL-8, STP-1).
  unsigned header_bits() const { return level_bits + step_bits + bias_bits; }
};

struct TileHead {
  uint64_t motion_mask = 0;
  uint64_t residual_mask = 0;
  uint64_t vectors_begin = 0;    ///< bit at which sign_mode stands, or would
  uint64_t residuals_begin = 0;  ///< bit at which level_base stands, or would
  TileVectors vectors;
  TileResiduals residuals;
};

/// Reads the head at the cursor, which stands at the start of the record. Afterwards all positions
/// in the head lie within the record. Errors: tile_overrun, mask_outside, bad_mode, bad_levels,
/// vector_range.
Result<TileHead> read_tile_head(FieldCursor& cursor, const TileContext& context);

}  // namespace hmlfc
