// How far the views of a light field move against each other.
#pragma once

#include <hmlfc/format.hpp>
#include <hmlfc/light_field.hpp>

#include "encoder/disparity_search.hpp"

namespace hmlfc {

/// What is found once for a light field.
struct FieldDisparity {
  DisparityRange range;  ///< in units of the header's disparity_precision
  int row_scale = 16;    ///< 16, or -16 where rows run against their parallax
};

/// Looks in the group of views in the middle of the grid, up to 12 samples a view. `header` has
/// shared_disparity.
FieldDisparity probe_disparities(const LightField& light_field, const StreamHeader& header);

}  // namespace hmlfc
