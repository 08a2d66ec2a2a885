// Rows of a view's disparity map.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/disparity.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc {

/// Rows [begin, end) of blocks of the disparity map of `view`, which exist: what block_disparity
/// gives, and confidence 0 for a block whose disparity has an error (SRF-3).
std::vector<BlockDisparity> disparity_rows(const StreamView& stream, ViewPos view, uint32_t begin,
                                           uint32_t end);

}  // namespace hmlfc
