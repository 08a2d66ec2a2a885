// Motion of one predictive image: palettes and indices of its motion tiles (MOT-3 to MOT-8).
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/motion_prediction.hpp"
#include "encoder/rate_distortion.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// Inputs from which the motion of one image is decided.
struct MotionTask {
  const MotionSources& sources;
  const SamplePlane& target;   ///< plane Y; at levels that are not keyed less the parent
  ReferencePlanes references;  ///< of plane Y
  unsigned choices;  ///< disparities tried: 1 the own one, 5 with four neighbours, 9 with all
  size_t vectors;    ///< blocks of a tile for which vectors are searched (VectorSearch)
  Lambda lambda;
};

/// The motion tiles of the image, row by row, each the cheapest in D + lambda R that was found.
std::vector<MotionTileCode> decide_motion(const MotionTask& task);

}  // namespace hmlfc
