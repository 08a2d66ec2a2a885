// Walks: from a block's place to what the stream says about it (BND-1, BND-3).
#pragma once

#include <cstddef>
#include <cstdint>

#include <hmlfc/error.hpp>

#include "decoder/block_motion.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// A block as the stream holds it.
struct CodedBlock {
  BlockEntry entry;
  BlockValues residual;  ///< all 0 without a residual; each in [-M, M]
};

/// Finds and reads the block at `probe.site`, which exists and is not in a key image: index, tile
/// head, entry, values. Errors: those of find_tile, read_tile_head and read_block_entry.
Result<CodedBlock> walk_to_block(const StreamView& stream, const Probe& probe);

/// A sample of a motion plane.
struct MotionPlace {
  size_t motion_plane = 0;  ///< index in Geometry::motion_planes()
  uint32_t x = 0;
  uint32_t y = 0;
};

/// (X, Y) of MOT-4 for block `site` of a stream with motion tiles.
MotionPlace motion_place(const StreamView& stream, const BlockSite& site);

/// The motion of a block as motion tiles hold it.
struct CodedMotion {
  PaletteEntry entry;
  int32_t disparity = 0;  ///< [-4096, 4095]; 0 unless the entry shares one
};

/// Finds and reads the motion of the block at `probe.site`, which exists in a predictive image of a
/// stream with motion tiles: its motion tile, then its disparity (MOT-10). Errors: those of
/// find_tile, read_motion_head, read_motion_entry, read_disparity_head and read_disparity.
Result<CodedMotion> walk_to_coded_motion(const StreamView& stream, const Probe& probe);

/// Does the same and returns the vectors that follow (MOT-7 to MOT-9).
Result<BlockMotion> walk_to_motion(const StreamView& stream, const Probe& probe);

/// Finds and reads the disparity of grid block `block` of a motion plane of the reference image at
/// `probe.site` (MOT-6), in [-4096, 4095]. Errors: those of find_tile, read_disparity_head and
/// read_disparity.
Result<int32_t> walk_to_disparity(const StreamView& stream, size_t motion_plane,
                                  const GridBlock& block, const Probe& probe);

}  // namespace hmlfc
