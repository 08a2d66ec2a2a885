// Tile records field by field, as TIL-1, TIL-3, TIL-6, TIL-8, TIL-9 and STP-1 list them.
#pragma once

#include <cstdint>
#include <vector>

#include "bits/bit_writer.hpp"
#include "syntax/tile_head.hpp"

namespace hmlfc {

/// A bounded integer sequence of `values` with the levels of `level_code`.
struct SequenceFields {
  unsigned level_code = 0;       ///< [0, kMaxLevelCode]
  std::vector<uint32_t> values;  ///< each below the number of levels
  std::vector<uint32_t> codes;   ///< T or Q of each group; empty: the canonical ones (BISE-10)
};

void put_sequence(BitWriter& writer, const SequenceFields& sequence);

/// The fields from sign_mode to vectors_y (TIL-6).
struct VectorFields {
  uint32_t sign_mode = 0;
  int32_t min_x = 0;
  int32_t min_y = 0;
  std::vector<bool> negative;  ///< of each block with motion; written with sign_mode 2
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

/// A whole record. Fields that TIL-1 makes depend on others are written if those say so.
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
