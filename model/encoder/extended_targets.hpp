// From one quality number to what each plane is coded with (profile extended).
#pragma once

#include <array>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

#include "encoder/extended_level.hpp"

namespace hmlfc {

/// Squared error of a sample of Y that saves one bit: 1 at quality 100, twice as much every 8
/// below; quality in [0, 100].
Lambda lambda_of_quality(double quality);

/// How much `preset` tries.
ExtendedEffort effort_of(Preset preset);

/// Lambda, step and key error of every plane. Key errors are found on the middle key image of the
/// views, so that a key image costs about what it saves in all images predicted from it.
std::array<PlaneTarget, kPlaneCount> extended_targets(const LightField& light_field,
                                                      const StreamHeader& header,
                                                      const EncodeParams& params, Lambda lambda);

}  // namespace hmlfc
