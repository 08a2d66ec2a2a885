// The pixels of a frame whose blocks are in the cache.
#pragma once

#include <hmlfc/camera.hpp>
#include <hmlfc/image.hpp>

#include "render/view_cache.hpp"

namespace hmlfc {

/// Fills `image` with the frame (sections 3 and 4 of docs/rendering.md); `cache` holds every block
/// that the frame needs. On all threads of the caller's arena.
void sample_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                  ViewCache& cache, RgbImage& image);

}  // namespace hmlfc
