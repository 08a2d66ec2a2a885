// Tile records (TIL-1 to TIL-9, STP-1): reading the head and the entry of one block, and writing
// all fields.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

#include "arithmetic/bise.hpp"
#include "bits/bit_string.hpp"
#include "syntax/field_cursor.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {

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

/// Values of sign_mode (TIL-6); 3 is reserved.
enum SignMode : uint32_t { kSignsPlus = 0, kSignsMinus = 1, kSignsMixed = 2 };

/// Facts about a tile's record that follow from its place in the tree.
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

/// Returns what the place of the tile that holds block `site` says about its record.
TileContext tile_context(const StreamView& stream, const BlockSite& site);

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

/// A bounded integer sequence of `values` with the level count of `level_code`.
struct SequenceFields {
  unsigned level_code = 0;       ///< [0, kMaxLevelCode]
  std::vector<uint32_t> values;  ///< each below that count
  std::vector<uint32_t> codes;  ///< T or Q of each digit group; empty: the canonical ones (BISE-10)
};

/// Appends the sequence.
void put_sequence(BitWriter& writer, const SequenceFields& sequence);

/// The fields from sign_mode to vectors_y (TIL-6).
struct VectorFields {
  uint32_t sign_mode = 0;
  int32_t min_x = 0;
  int32_t min_y = 0;
  std::vector<bool> negative;  ///< of each block with motion; written with kSignsMixed
  SequenceFields x;
  SequenceFields y;
};

/// One block with a residual (TIL-8, TIL-9, STP-1).
struct ResidualBlockFields {
  unsigned step_code = 0;
  int32_t bias = 0;
  SequenceFields values;
};

/// The fields from level_base to the last block value.
struct ResidualFields {
  unsigned level_base = 0;
  unsigned level_bits = 0;
  unsigned bias_bits = 0;
  unsigned step_base = 0;
  unsigned step_bits = 0;
  std::vector<ResidualBlockFields> blocks;
};

/// A whole record. A field whose presence depends on others (TIL-1) is written if they say so.
struct TileFields {
  uint32_t motion_mode = 0;
  uint32_t residual_mode = 0;
  uint64_t motion_mask = 0;
  uint64_t residual_mask = 0;
  VectorFields vectors;
  ResidualFields residuals;
};

/// The bytes of the record. A field outside its interval is cut to its bits.
std::vector<uint8_t> write_tile_fields(const TileFields& tile, const TileContext& context);

}  // namespace hmlfc
