// Two walks (BND-3): from a block's place to its motion, and to the disparity that it needs.
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/block_motion.hpp"
#include "syntax/disparity_tile.hpp"
#include "syntax/probe.hpp"

namespace hmlfc {

/// A sample of a motion plane.
struct MotionPlace {
  size_t motion_plane = 0;  ///< index in Geometry::motion_planes()
  uint32_t x = 0;
  uint32_t y = 0;
};

/// (X, Y) of MOT-4 for block `site` of a stream with motion tiles.
MotionPlace motion_place(const StreamView& stream, const BlockSite& site);

/// Finds and reads the motion of the block at `probe.site`, which exists in a predictive image of a
/// stream with motion tiles: its motion tile, then its disparity (MOT-10). Errors: those of
/// find_tile, read_motion_head, read_motion_entry, read_disparity_head and read_disparity.
Result<BlockMotion> walk_to_motion(const StreamView& stream, const Probe& probe);

}  // namespace hmlfc
