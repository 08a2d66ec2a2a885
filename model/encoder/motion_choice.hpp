// Motion of one predictive image: palettes and indices of its motion tiles (MOT-3 to MOT-8).
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/rate_distortion.hpp"
#include "encoder/subpel_prediction.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// What the motion of one image is chosen from.
struct MotionTask {
  const SamplePlane* target = nullptr;  ///< plane Y; at levels that are not keyed less the parent
  ReferencePlanes references{};         ///< of plane Y
  ReferenceImages places{};
  ImagePos at;
  const DisparityGrid* grid = nullptr;
  VectorRules rules;
  unsigned vector_precision = 0;
  MotionPlaneShape shape;
  unsigned tile_log2 = 6;
  unsigned grid_log2 = 3;
  unsigned least_block_log2 = 2;  ///< of a motion block: that of a residual block
  bool keyed = true;
  bool two_references = true;
  unsigned choices = 9;  ///< disparities tried: 1 the own one, 5 with four neighbours, 9 with all
  Lambda lambda;

  PaletteFields fields() const { return {two_references, !keyed}; }
};

/// The motion tiles of the image, row by row, each the cheapest in D + lambda R that was found.
std::vector<MotionTileCode> choose_motion(const MotionTask& task);

}  // namespace hmlfc
