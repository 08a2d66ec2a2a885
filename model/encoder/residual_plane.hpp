// Residuals of one plane on top of its prediction (STP).
#pragma once

#include "encoder/decisions.hpp"
#include "encoder/residual_decision.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Decides and writes the residuals of `plane` of an image; `original` and `prediction` hold whole
/// blocks. `residuals` of the result are set if `is_reference`.
EncodedPlane encode_residuals(const Geometry& geometry, Plane plane, int depth,
                              const SamplePlane& original, const SamplePlane& prediction,
                              bool is_reference, const ResidualRules& rules);

}  // namespace hmlfc
