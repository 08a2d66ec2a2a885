// Residuals of one plane on top of its prediction (STP).
#pragma once

#include "encoder/plane_encoder.hpp"
#include "encoder/residual_choice.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Chooses and writes the residuals of `plane` of the image; `original` and `prediction` hold whole
/// blocks. `samples` of the result are what a decoder makes; `residuals` are set if `is_reference`.
EncodedPlane encode_residuals(const Geometry& geometry, Plane plane, int depth,
                              const SamplePlane& original, const SamplePlane& prediction,
                              bool is_reference, const ResidualRules& rules);

}  // namespace hmlfc
