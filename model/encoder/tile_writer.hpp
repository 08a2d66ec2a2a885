// Writes what profile main decides for blocks as tile records (TIL-1 to TIL-10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

#include "decoder/sample_plane.hpp"
#include "encoder/motion_search.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// Decision for one block.
struct BlockDecision {
  BlockState state = BlockState::kZero;
  MotionMatch motion{};  ///< with motion
  BlockValues residual;  ///< with a residual: exact differences, each in [-M, M]

  explicit BlockDecision(unsigned block_size) : residual(block_size) {}

  bool has_motion() const {
    return state == BlockState::kMotion || state == BlockState::kMotionResidual;
  }
  bool has_residual() const {
    return state == BlockState::kResidual || state == BlockState::kMotionResidual;
  }
};

/// The record of a tile. `decisions` has one entry for each block number; those outside the plane
/// are in state zero. Empty where all blocks are zero (IDX-7).
std::vector<uint8_t> write_tile(std::span<const BlockDecision> decisions,
                                const TileContext& context);

}  // namespace hmlfc
