// A rectangle of blocks by the golden path, one decode_block after another.
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/block_rect.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// What decode_region returns, with the error of the first block, row by row, that does not decode
/// (CNV-7). `sources.references` may be null.
Result<SamplePlane> decode_region_by_blocks(const DecodeSources& sources, int level, ImagePos image,
                                            Plane plane, const BlockRect& rect);

}  // namespace hmlfc
