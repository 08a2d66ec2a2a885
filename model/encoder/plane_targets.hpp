// From one quality number to what each plane is coded with (profile extended).
#pragma once

#include <array>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

#include "encoder/residual_decision.hpp"

namespace hmlfc {

/// How good a plane has to be.
struct PlaneTarget {
  ResidualRules residuals;
  double key_error = 0;  ///< mean squared error of key images; 0 means lossless
};
using PlaneTargets = std::array<PlaneTarget, kPlaneCount>;

/// How much is tried.
struct SearchEffort {
  unsigned choices = 9;       ///< of MotionTask
  unsigned steps_around = 1;  ///< of ResidualRules
};
SearchEffort effort_of(Preset preset);

/// Squared error of a sample of Y that is worth one bit: 1 at quality 100, doubled for every 8
/// below; quality in [0, 100].
Lambda lambda_of_quality(double quality);

/// Lambda, step and key error of every plane. Key errors are found on the middle key image of the
/// views, so that a key image costs about what it saves in all images predicted from it.
PlaneTargets plane_targets(const LightField& light_field, const StreamHeader& header,
                           const EncodeParams& params);

}  // namespace hmlfc
