// Geometry of a stream: where it says that things are (docs/rendering.md, section 8).
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/trace.hpp>

namespace hmlfc {

/// Units of a disparity in one pixel a column of views (GEO-1).
inline constexpr int kDisparityUnits = 256;

/// Depth of a block as the stream states it.
struct BlockDisparity {
  int16_t disparity = 0;   ///< units of 2^-8 pixels a column; negative is nearer (CAM-2)
  uint8_t confidence = 0;  ///< [0, 3] (GEO-6); 0: the stream says nothing, and the disparity is 0

  friend bool operator==(const BlockDisparity&, const BlockDisparity&) = default;
};

/// The disparity map of a view (GEO-1).
struct DisparityMap {
  uint32_t width = 0;                  ///< of a view, [1, 65536] pixels
  uint32_t height = 0;                 ///< [1, 65536] pixels
  uint32_t block_size = 2;             ///< B: 2, 4 or 8 samples
  uint32_t columns = 0;                ///< of blocks: ceil(width / B)
  std::vector<BlockDisparity> blocks;  ///< row by row

  /// Returns the disparity of the block at sample position (`x`, `y`), which lies in the view.
  const BlockDisparity& at(uint32_t x, uint32_t y) const {
    return blocks[size_t{y / block_size} * columns + x / block_size];
  }
};

/// The disparity of block (`bx`, `by`) of plane Y of `view` (GEO-2), read by itself. What it costs
/// is added to `counts`, unless that is null: at most 2 * (tree_height + 1) walks (GEO-7). Errors:
/// those of GEO-7; bad_request where there is no such block.
HMLFC_EXPORT Result<BlockDisparity> block_disparity(const Decoder& decoder, ViewPos view,
                                                    uint32_t bx, uint32_t by,
                                                    AccessCounts* counts = nullptr);

/// The disparity map of `view`: for each block what block_disparity gives. Errors: that of the
/// first block that has one, row by row; bad_request, out_of_memory.
HMLFC_EXPORT Result<DisparityMap> disparity_map(const Decoder& decoder, ViewPos view);

}  // namespace hmlfc
