// The fast path's prediction by motion tiles: a rectangle of blocks, motion block by motion block.
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/block_rect.hpp"
#include "decoder/decode_sources.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// Turns `samples`, which hold the parent's in `rect`, to A of DEC-3 for all blocks with motion of
/// predictive image `image` of level `level`. The stream has motion tiles, `sources.references` is
/// set. On failure some block of `rect` does not decode.
Result<void> add_motion(const DecodeSources& sources, int level, ImagePos image, Plane plane,
                        const BlockRect& rect, SamplePlane& samples);

}  // namespace hmlfc
