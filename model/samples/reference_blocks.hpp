// Where motion finds its reference (DEC-4, DEC-5).
#pragma once

#include <hmlfc/error.hpp>

#include "fields/geometry.hpp"
#include "samples/block_values.hpp"

namespace hmlfc {

/// One plane of one reference image, block by block.
class ReferenceBlocks {
 public:
  virtual ~ReferenceBlocks() = default;

  /// Block (bx, by) of the plane, which exists: key samples at the top level, residuals below it
  /// (DEC-4). Positions outside the plane have no meaning.
  virtual Result<BlockValues> block(uint32_t bx, uint32_t by) = 0;
};

/// The B x B values of ref(x + i, y + j), i and j in [0, B - 1], with the border rule (DEC-5). x
/// and y may lie outside the plane. Asks for at most 2 x 2 blocks, row by row.
///
/// Example: B = 4, x = -6, y = 5 in a wide plane: all columns read column 0, rows 5 to 8.
Result<BlockValues> gather_reference(ReferenceBlocks& blocks, const PlaneShape& plane,
                                     unsigned block_size, int32_t x, int32_t y);

}  // namespace hmlfc
