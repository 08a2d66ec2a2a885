// One plane of a predictive image with its motion decided: what the residuals are added to (DEC-3).
#pragma once

#include <span>

#include "arithmetic/motion.hpp"
#include "encoder/subpel_prediction.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// What the prediction of one plane needs.
struct PredictionTask {
  const Geometry* geometry = nullptr;
  Plane plane = Plane::kY;
  int depth = 8;
  const SamplePlane* parent = nullptr;  ///< whole blocks; null where it is 0
  bool keyed = true;
  ReferencePlanes references{};
  ReferenceImages places{};
  ImagePos at;
  const DisparityGrid* grid = nullptr;
  VectorRules rules;
  unsigned vector_precision = 0;
  unsigned tile_log2 = 6;
  unsigned grid_log2 = 3;
  PaletteEntry default_symbol;            ///< of empty motion tiles (MOT-4)
  std::span<const MotionTileCode> tiles;  ///< of the motion plane that serves `plane`
};

/// A(x, y) of DEC-3 for every block of the plane, in whole blocks.
SamplePlane predict_plane(const PredictionTask& task);

}  // namespace hmlfc
