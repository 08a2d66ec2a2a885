// The fast path: a rectangle of blocks of one plane, tile by tile, equal to decode_block on each.
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/fast/sparse_plane.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
/// Adds image `image` of level `level` to `samples`, which hold the samples of its parent in `rect`
/// (0 at the top level; any values for a key image) and afterwards its own (DEC-2, DEC-3). Shape,
/// sources and errors as for decode_region.
Result<void> add_level(const FastSources& sources, int level, ImagePos image, Plane plane,
                       const BlockRect& rect, SamplePlane& samples);

/// Decodes `rect` of plane `plane` of image `image` of level `level` with all its ancestors. The
/// result has whole blocks: (bx1 - bx0) * B x (by1 - by0) * B samples; those outside the plane have
/// no meaning. On failure some block that the rectangle needs does not decode; the error need not
/// be the first in the order of CNV-7.
Result<SamplePlane> decode_region(const FastSources& sources, int level, ImagePos image,
                                  Plane plane, const BlockRect& rect);

/// Turns `samples`, which hold the parent's in `rect`, into A of DEC-3 for all blocks with motion
/// of predictive image `image` of level `level`. The stream has motion tiles. On failure some block
/// of `rect` does not decode.
Result<void> add_motion(const FastSources& sources, int level, ImagePos image, Plane plane,
                        const BlockRect& rect, SamplePlane& samples);

}  // namespace hmlfc
