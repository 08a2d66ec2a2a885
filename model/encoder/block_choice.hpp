// What the encoder decides for one block.
#pragma once

#include <cstdint>

#include <hmlfc/format.hpp>

#include "decoder/sample_plane.hpp"
#include "encoder/motion_search.hpp"

namespace hmlfc {

/// The state of one block with what it takes.
struct BlockChoice {
  BlockState state = BlockState::kZero;
  MotionMatch motion{};  ///< with motion
  BlockValues residual;  ///< with a residual: exact differences, each in [-M, M]

  explicit BlockChoice(unsigned block_size) : residual(block_size) {}

  bool has_motion() const {
    return state == BlockState::kMotion || state == BlockState::kMotionResidual;
  }
  bool has_residual() const {
    return state == BlockState::kResidual || state == BlockState::kMotionResidual;
  }
};

}  // namespace hmlfc
