// Rectangles of blocks.
#pragma once

#include <cstdint>

#include "syntax/geometry.hpp"

namespace hmlfc {

/// Blocks [bx0, bx1) x [by0, by1) of a plane, not empty.
struct BlockRect {
  uint32_t bx0 = 0;
  uint32_t by0 = 0;
  uint32_t bx1 = 0;
  uint32_t by1 = 0;
};

/// All blocks of a plane.
inline BlockRect whole_plane(const PlaneShape& plane) {
  return {0, 0, plane.blocks_x, plane.blocks_y};
}

}  // namespace hmlfc
