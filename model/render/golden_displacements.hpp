// The displacements of a frame as docs/rendering.md, section 9, reads: from single blocks.
#pragma once

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

#include "render/displaced_cells.hpp"

namespace hmlfc {

/// Those of the cells of the frame of `record` with `stop_level`, which fit the light field (SRF-1,
/// SRF-3).
CellDisplacements golden_displacements(const Decoder& decoder, const FrameRecord& record,
                                       int stop_level);

}  // namespace hmlfc
