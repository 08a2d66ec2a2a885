// The disparities of a reference group (MOT-5, MOT-6).
#pragma once

#include <cstdint>

#include <hmlfc/error.hpp>

#include "arithmetic/levels.hpp"
#include "syntax/field_cursor.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// Greatest level code of disparities: that of 1024 levels.
inline constexpr unsigned kMaxDisparityCode = 27;

/// The grid blocks of one motion tile that lie at least partly in the plane.
struct DisparityContext {
  uint32_t columns = 1;  ///< [1, 32]
  uint32_t rows = 1;

  uint64_t blocks() const { return uint64_t{columns} * rows; }
};

/// The context of motion tile `place` of a reference image; the stream has shared_disparity.
DisparityContext disparity_context(const StreamView& stream, const MotionTilePlace& place);

/// A record but for its values, which are there: they begin at bit values_at.
struct DisparityHead {
  int32_t least = 0;  ///< min_disparity, [-4096, 4095]
  Levels levels;
  uint64_t values_at = 0;
};

/// Reads the record at the cursor up to its values. Errors: tile_overrun, also where a value is not
/// there, and bad_levels.
Result<DisparityHead> read_disparity_head(FieldCursor& cursor, const DisparityContext& context);

/// The disparity of grid block (gx, gy) of the tile, found by position; in [-4096, 4095]. Errors:
/// vector_range.
Result<int32_t> read_disparity(const FieldCursor& cursor, const DisparityHead& head,
                               const DisparityContext& context, uint32_t gx, uint32_t gy);

/// A grid block of a motion plane.
struct GridBlock {
  uint32_t gx = 0;
  uint32_t gy = 0;
  friend bool operator==(const GridBlock&, const GridBlock&) = default;
};

/// The grid block of 2^grid_log2 samples a side from which a block whose place is sample (x, y) of
/// motion plane `plane` takes its disparity with `choice` in [1, 9] (MOT-5, MOT-6).
///
/// Example: place (8, 0), grid of 4: choice 1 reads grid block (2, 0), choice 2, to the left,
/// (1, 0), choice 4, above, (2, 0).
GridBlock grid_block(uint32_t x, uint32_t y, unsigned choice, unsigned grid_log2,
                     const MotionPlaneShape& plane);

}  // namespace hmlfc
