// Which blocks a frame needs (NED-1), row by row.
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

#include "render/view_cache.hpp"

namespace hmlfc {

/// Sets `needed` of every view of the cache that the frame uses; `cache` has begun a frame. Returns
/// the samples that the frame reads, three a pixel (FrameCounts::samples_interpolated). On all
/// threads of the caller's arena.
uint64_t plan_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                    ViewCache& cache);

}  // namespace hmlfc
