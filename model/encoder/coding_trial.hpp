// Estimates what an encoding would cost, from some images of a part of all views.
#pragma once

#include <cstdint>
#include <deque>

#include <hmlfc/encoder.hpp>
#include <hmlfc/view_provider.hpp>

#include "encoder/cached_views.hpp"
#include "encoder/light_field_probe.hpp"
#include "encoder/rate_distortion.hpp"

namespace hmlfc {

/// What parameters are tried on: of each view the same parts, of one size, which have at most
/// 384x256 pixels together.
using TrialParts = std::deque<CachedViews>;

/// Those of `views`, which must outlive them. They keep at most `max_bytes`, as CachedViews do.
TrialParts trial_parts(const ViewProvider& views, uint64_t max_bytes);

/// Error and size of an encoding of all views, as estimated.
struct TrialResult {
  double rgb_squares = 0;  ///< as in ErrorSums
  double bits = 0;
  double seconds = 0;  ///< here and now

  /// D + lambda R, in units of squared error of plane Y.
  double cost(Lambda lambda) const {
    return rgb_squares / 3 + static_cast<double>(lambda.scaled) / 256 * bits;
  }
};

/// Estimates for views of `whole` an encoding with `params` of profile extended, nothing open, from
/// about `images` images of each of `parts`, with all it refers to. Infinite where no header
/// allows it.
TrialResult try_coding(const LightFieldShape& whole, const TrialParts& parts,
                       const EncodeParams& params, const LightFieldProbe& probe, size_t images);

}  // namespace hmlfc
