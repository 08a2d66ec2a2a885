// Which blocks of a tile get a residual, with which step and how many levels (STP, TIL-8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/sample_plane.hpp"
#include "encoder/rate_distortion.hpp"
#include "encoder/residual_costs.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// The bits of a record of residuals without its mask and blocks: mask_mode 2, level_base 6,
/// level_bits 3, bias_bits 4, step_base 4, step_bits 2.
inline constexpr int64_t kLeastResidualBits = 21 + kTileOverheadBits;

/// About what a block takes in a mask.
inline constexpr int64_t kMaskBitsPerBlock = 2;

/// How the residuals of one tile are decided.
struct ResidualRules {
  Lambda lambda;
  unsigned step_code = 0;                   ///< about the best step
  unsigned steps_below = 1;                 ///< finer ones tried, too
  unsigned steps_above = 2;                 ///< coarser ones
  bool lossless = false;                    ///< every difference is kept: step 1, no clipping
  size_t bias_widths = kBiasWidthsOfSteps;  ///< of kTriedBiasBits, in [1, 8]
  unsigned level_codes = kLevelCodes;       ///< tried
};

/// The residuals of a tile.
struct ResidualTile {
  uint64_t mask = 0;
  ResidualFields fields;            ///< of the blocks of the mask, ascending
  std::vector<BlockValues> blocks;  ///< what a decoder adds, before it clamps (STP-3)
};

/// Decides for the differences (original less prediction) of the blocks of a tile, by block number;
/// those outside context.blocks_inside are ignored.
ResidualTile decide_residuals(std::span<const BlockValues> differences, const TileContext& context,
                              const ResidualRules& rules);

/// The tile's record in a stream with motion_tiles and residual_step (MOT-2, STP-1); empty without
/// residuals.
std::vector<uint8_t> write_residual_tile(const ResidualTile& tile, const TileContext& context);

}  // namespace hmlfc
