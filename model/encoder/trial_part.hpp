// The part of a light field's views that trials code instead of the whole.
#pragma once

#include <hmlfc/format.hpp>
#include <hmlfc/view_provider.hpp>

namespace hmlfc {

/// The part of `views` on which parameters are tried: of each the same rectangle of at most 384x256
/// pixels, the one most like the whole. `header` is one for `views`.
Rect trial_part(const ViewProvider& views, const StreamHeader& header);

}  // namespace hmlfc
