// The displacements of a frame with geometry (SRF-1, SRF-3), from maps, in vectors of cells.
#pragma once

#include <hmlfc/camera.hpp>

#include "render/disparity_cache.hpp"
#include "render/displaced_cells.hpp"

namespace hmlfc {

/// What golden_displacements() gives, by the maps of `cache`, which has begun a frame, into
/// `found`, whose memory is reused. Uses all threads of the caller's run_on_threads().
void find_displacements(const FrameRecord& record, int stop_level, unsigned block_log2,
                        DisparityCache& cache, CellDisplacements& found);

}  // namespace hmlfc
