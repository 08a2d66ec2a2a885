// From a block's place to the bits of its tile's record and what they mean, and the same for motion
// tiles.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

#include "bits/bit_string.hpp"
#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_head.hpp"

namespace hmlfc {

/// The record of one tile.
struct TileRecord {
  BitString bits;
  uint64_t file_bit = 0;  ///< address of its first bit from the start of the file
};

/// The record of the tile that holds block `site`, which exists and is not in a key image; nothing
/// where the tile is empty (IDX-7). Errors: those of find_tile.
Result<std::optional<TileRecord>> find_record(const StreamView& stream, const BlockSite& site,
                                              const Probe& probe);

/// What the place of that tile says about its record.
TileContext tile_context(const StreamView& stream, const BlockSite& site);

/// A motion tile of one image (MOT-1).
struct MotionTilePlace {
  int level = 0;
  ImagePos image;
  size_t motion_plane = 0;  ///< index in Geometry::motion_planes()
  uint32_t tx = 0;
  uint32_t ty = 0;

  friend bool operator==(const MotionTilePlace&, const MotionTilePlace&) = default;
};

/// The record of the motion tile `place`, which exists; nothing where it is empty. Errors: those of
/// find_tile.
Result<std::optional<TileRecord>> find_motion_record(const StreamView& stream,
                                                     const MotionTilePlace& place,
                                                     const Probe& probe);

/// The samples of motion tile `place` that lie in the plane: from (x0, y0), width x height.
struct MotionTileArea {
  uint32_t x0 = 0;
  uint32_t y0 = 0;
  uint32_t width = 0;   ///< [1, S]
  uint32_t height = 0;  ///< [1, S]
};

MotionTileArea motion_tile_area(const StreamView& stream, const MotionTilePlace& place);

}  // namespace hmlfc
