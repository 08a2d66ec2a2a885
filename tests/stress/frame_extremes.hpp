// Frames at the ends of what the clauses of docs/rendering.md allow.
#pragma once

#include <functional>
#include <string>

namespace hmlfc::stress {

/// Cameras before light fields of all sizes, and records that keep to REC-2 and REC-3 but are no
/// camera's, each of which drives quantities of section 6 to an end of their intervals. Rays,
/// weights and taps are computed, at the corners and the middle of the frame, but no samples: no
/// stream is needed. Calls done(name) after each.
void run_frame_extremes(const std::function<void(const std::string& name)>& done);

}  // namespace hmlfc::stress
