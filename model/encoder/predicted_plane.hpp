// One plane of a predictive image with its motion decided: what the residuals are added to (DEC-3).
#pragma once

#include <span>

#include "encoder/subpel_prediction.hpp"

namespace hmlfc {

/// A(x, y) of DEC-3 for every block of `plane`, in whole blocks. `parent`: whole blocks, null where
/// it is 0; `references`: of `plane`; `tiles`: of the motion plane.
SamplePlane predict_plane(const MotionSources& sources, Plane plane, const SamplePlane* parent,
                          const ReferencePlanes& references, std::span<const MotionTileCode> tiles);

}  // namespace hmlfc
