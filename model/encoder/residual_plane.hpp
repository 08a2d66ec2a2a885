// Residuals of one plane on top of its prediction (STP).
#pragma once

#include "encoder/decisions.hpp"
#include "encoder/residual_decision.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// A plane coded by its residuals alone, in whole blocks.
struct ResidualPlane {
  PlaneCode code;
  SamplePlane samples;    ///< what a decoder makes of it (DEC-3)
  SamplePlane residuals;  ///< TIL-10, 0 where there is none; set for reference images
};

/// Decides and writes the residuals of `plane` of an image; `original` and `prediction` hold whole
/// blocks. `residuals` of the result are set if `is_reference`.
ResidualPlane encode_residuals(const Geometry& geometry, Plane plane, int depth,
                               const SamplePlane& original, const SamplePlane& prediction,
                               bool is_reference, const ResidualRules& rules);

}  // namespace hmlfc
