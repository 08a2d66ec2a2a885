// focus_at of a stream whose bytes are loaded.
#pragma once

#include <hmlfc/focus.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc {

/// As focus_at; what a partial source lacks it notes and answers with bus_error, or leaves out.
Result<FocusPoint> find_focus(const StreamView& stream, const Camera& camera, uint32_t x,
                              uint32_t y);

}  // namespace hmlfc
