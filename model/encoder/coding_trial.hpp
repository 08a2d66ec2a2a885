// Estimates what an encoding would cost, from some images of a part of all views.
#pragma once

#include <hmlfc/encoder.hpp>
#include <hmlfc/view_provider.hpp>

#include "encoder/light_field_probe.hpp"
#include "encoder/rate_distortion.hpp"

namespace hmlfc {

/// The part of `views` on which parameters are tried: of each the same rectangle of at most 384x256
/// pixels, the one most like the whole. `header` is one for `views`.
Rect trial_part(const ViewProvider& views, const StreamHeader& header);

/// Error and size of an encoding of all views, as estimated.
struct TrialResult {
  double rgb_squares = 0;  ///< as in ErrorSums
  double bits = 0;

  /// D + lambda R, in units of squared error of plane Y.
  double cost(Lambda lambda) const {
    return rgb_squares / 3 + static_cast<double>(lambda.scaled) / 256 * bits;
  }
};

/// Estimates for views of `whole` an encoding with `params` of profile extended, nothing open, from
/// about `images` images of `part`, each with all it refers to. Infinite where no header allows it.
TrialResult try_coding(const LightFieldShape& whole, const ViewProvider& part,
                       const EncodeParams& params, const LightFieldProbe& probe, size_t images);

}  // namespace hmlfc
