// Disparities of blocks: of one, as docs/rendering.md, section 8, reads, and of rows of a map.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/disparity.hpp>

#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// The disparity of block (bx, by) of plane Y of `view`, which exist (GEO-2). Errors: GEO-7.
Result<BlockDisparity> walk_to_block_disparity(const StreamView& stream, ViewPos view, uint32_t bx,
                                               uint32_t by, AccessCounts* counts);

/// Rows [begin, end) of blocks of the disparity map of `view`, which exist: the disparities of
/// walk_to_block_disparity, with confidence 0 for a block whose disparity has an error (SRF-3).
std::vector<BlockDisparity> disparity_rows(const StreamView& stream, ViewPos view, uint32_t begin,
                                           uint32_t end);

}  // namespace hmlfc
