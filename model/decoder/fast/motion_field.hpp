// The fast path's reader of motion tiles: all motion blocks of a tile at once, equal to
// read_motion_entry on each.
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/error.hpp>

#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// Motion blocks of one motion tile: 32 x 32 of 4 samples in 128 x 128.
inline constexpr size_t kMaxMotionBlocks = 1024;

/// One motion tile.
struct MotionField {
  MotionHead head;
  std::array<bool, kMaxPaletteEntries> usable{};
  std::array<uint16_t, kMaxMotionBlocks> indices{};

  /// The entry of motion block (mx, my) of the tile, or null where it has none that it may use.
  const PaletteEntry* entry(uint32_t mx, uint32_t my) const {
    const uint16_t index = indices[my * head.columns + mx];
    return index < head.entries && usable[index] ? &head.palette[index] : nullptr;
  }
};

/// Reads motion tile `place` of a predictive image. Errors: those of find_tile and
/// read_motion_head.
Result<void> read_motion_field(const StreamView& stream, const MotionTilePlace& place,
                               MotionField& field);

}  // namespace hmlfc
