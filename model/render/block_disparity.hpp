// The disparity of one block as docs/rendering.md, section 8, reads.
#pragma once

#include <hmlfc/disparity.hpp>

#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// The disparity of block (bx, by) of plane Y of `view`, which exist (GEO-2). Errors: GEO-7.
Result<BlockDisparity> walk_to_block_disparity(const StreamView& stream, ViewPos view, uint32_t bx,
                                               uint32_t by, AccessCounts* counts);

}  // namespace hmlfc
