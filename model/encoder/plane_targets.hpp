// From one quality number to what each plane is coded with (profile extended).
#pragma once

#include <array>

#include <hmlfc/encoder.hpp>

#include "bits/exact_floats.hpp"
#include "encoder/light_field_probe.hpp"
#include "encoder/residual_decision.hpp"

namespace hmlfc {

/// How good a plane has to be.
struct PlaneTarget {
  ResidualRules residuals;
  KeyPoint key;  ///< of key images; asked = 0 means lossless
};
using PlaneTargets = std::array<PlaneTarget, kPlaneCount>;

/// How much is tried.
struct SearchEffort {
  unsigned choices = 5;          ///< of MotionTask
  size_t disparity_images = 12;  ///< of a group, for its disparities and its key image
  size_t vectors = 8;            ///< of MotionTask
};
SearchEffort effort_of(Preset preset);

/// Squared error of a sample of Y that is worth one bit: 1 at quality 100, doubled for every 8
/// below; quality in [-64, 132].
Lambda lambda_of_quality(double quality);

/// `lambda` for a plane: a squared error of Cg counts a quarter and one of Co a sixth of one of Y
/// in RGB, on four pixels in 4:2:0.
Lambda plane_lambda(Lambda lambda, Plane plane, ChromaFormat chroma);

/// How residuals of a plane are decided with the `lambda` of Y.
ResidualRules residual_rules(Lambda lambda, Plane plane, ChromaFormat chroma);

/// Lambda, step and key error of every plane. A key image costs about what it saves in all images
/// predicted from it.
PlaneTargets plane_targets(const StreamHeader& header, const EncodeParams& params,
                           const LightFieldProbe& probe);

}  // namespace hmlfc
