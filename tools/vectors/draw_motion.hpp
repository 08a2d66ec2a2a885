// The records of motion tiles by the rules of a recipe (MOT-3, MOT-6).
#pragma once

#include <cstdint>
#include <vector>

#include "syntax/motion_tile.hpp"
#include "syntax/motion_tile.hpp"
#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// The record of a motion tile of a predictive image; empty for an empty tile.
std::vector<uint8_t> draw_motion_record(FieldRules& rules, const MotionContext& context,
                                        Random& random);

/// The record of a motion tile of a reference image; empty for an empty tile.
std::vector<uint8_t> draw_disparity_record(FieldRules& rules, const DisparityContext& context,
                                           Random& random);

}  // namespace hmlfc::vectors
