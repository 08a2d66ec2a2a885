// The part of a light field's views that trials code in place of the whole.
#pragma once

#include <hmlfc/format.hpp>
#include <hmlfc/light_field.hpp>

namespace hmlfc {

/// The part of `light_field` on which parameters are tried: all views, of each the same rectangle
/// of at most 384x256 pixels, the one most like the whole. `header` is one for `light_field`.
LightField trial_part(const LightField& light_field, const StreamHeader& header);

}  // namespace hmlfc
