// A block of a plane held in memory.
#pragma once

#include <cstdint>

#include "decoder/block_values.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// Block (bx, by) of `plane` (DEC-2); positions outside the plane are 0.
inline BlockValues block_of_plane(const SamplePlane& plane, unsigned block_size, uint32_t bx,
                                  uint32_t by) {
  BlockValues values(block_size);
  for (unsigned j = 0; j < block_size; ++j) {
    for (unsigned i = 0; i < block_size; ++i) {
      const uint32_t x = bx * block_size + i;
      const uint32_t y = by * block_size + j;
      if (x < plane.width && y < plane.height) values.at(i, j) = plane.at(x, y);
    }
  }
  return values;
}

}  // namespace hmlfc
