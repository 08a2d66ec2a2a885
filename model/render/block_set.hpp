// The blocks that a frame needs, in the order of NED-2.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>

#include <hmlfc/decoder.hpp>

namespace hmlfc {

/// Blocks by view row by row, plane, block row by row.
struct BlockOrder {
  bool operator()(const BlockAddress& a, const BlockAddress& b) const {
    return std::tie(a.view.row, a.view.col, a.plane, a.by, a.bx) <
           std::tie(b.view.row, b.view.col, b.plane, b.by, b.bx);
  }
};

using BlockSet = std::set<BlockAddress, BlockOrder>;

}  // namespace hmlfc
