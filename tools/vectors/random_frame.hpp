// Random frames and maps for a renderer under test.
#pragma once

#include <cstdint>

#include <hmlfc/format.hpp>

#include "vectors/frame_case.hpp"

namespace hmlfc::vectors {

/// A camera, most often near the views and in part turned, and a stop level; or for one seed in
/// eight the map of a view. All for a stream of this header, and the same on every machine. A
/// camera may be refused.
FrameCase random_frame(uint64_t seed, const StreamHeader& header);

}  // namespace hmlfc::vectors
