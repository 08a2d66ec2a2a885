// Measures a light field before it is coded; the result serves every encoding.
#pragma once

#include <array>

#include <hmlfc/view_provider.hpp>

#include "encoder/disparity_search.hpp"
#include "encoder/key_curve.hpp"
#include "syntax/header.hpp"

namespace hmlfc {

/// How far the views of a light field move against each other, and what key images cost. Neither
/// depends on reference groups or quality.
struct LightFieldProbe {
  DisparityRange disparities;  ///< in units of the header's disparity_precision
  int row_scale = 16;  ///< of the header: 16, negative where rows run against their parallax
  /// Of the view in the middle: as it is, then refined for those around it, if there are any. Empty
  /// without lossy_keys. They measure what they are asked for, and share about nine views.
  std::array<std::vector<KeyCurve>, kPlaneCount> keys;
  /// The bits of a sample in whole views, as multiples of those that `keys` state; lossless without
  /// lossy_keys.
  std::array<double, kPlaneCount> key_bits{};
};

/// Whether views around the middle are predicted far better with rows taken for columns.
bool seems_transposed(const ViewProvider& views, const StreamHeader& header);

/// The row scales that may be the views': the better one of 16 and -16, for rows of cameras as far
/// apart as columns, then another one where that predicts the views around the middle better.
std::vector<int> likely_row_scales(const ViewProvider& views, const StreamHeader& header);

/// Looks at the views around the middle of the grid, up to 12 samples of disparity per view; key
/// images are measured in the middle of views. What the feature flags of `header` have no use for
/// is left out. Throws std::bad_alloc.
LightFieldProbe probe_light_field(const ViewProvider& views, const StreamHeader& header,
                                  int row_scale);

}  // namespace hmlfc
