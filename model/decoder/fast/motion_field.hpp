// Motion tiles and disparities, all values of a tile at once, equal to read_motion_entry and
// read_disparity on each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <hmlfc/error.hpp>

#include "decoder/lazy_map.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// Motion blocks of one motion tile: 32 x 32 of 4 samples in 128 x 128.
inline constexpr size_t kMaxMotionBlocks = 1024;

/// One motion tile.
struct MotionField {
  MotionHead head;
  std::array<bool, kMaxPaletteEntries> usable{};
  std::array<uint16_t, kMaxMotionBlocks> indices{};

  /// The entry of motion block (mx, my) of the tile; null if it has none that it may use.
  const PaletteEntry* entry(uint32_t mx, uint32_t my) const {
    const uint16_t index = indices[my * head.columns + mx];
    return index < head.entries && usable[index] ? &head.palette[index] : nullptr;
  }
};

/// Reads motion tile `place` of a predictive image. Errors: those of find_tile and
/// read_motion_head.
Result<void> read_motion_field(const StreamView& stream, const MotionTilePlace& place,
                               MotionField& field);

/// Palette entries of blocks of predictive images, asked for tile by tile: the motion tile read
/// last is kept. Not thread-safe.
class MotionEntries {
 public:
  /// `stream` has motion tiles, or nothing is asked for; it must outlive this.
  explicit MotionEntries(const StreamView& stream) : stream_(stream) {}

  /// The entry of the block at `site`; null if it has none that it may use. Errors: those of
  /// read_motion_field.
  Result<const PaletteEntry*> find(const BlockSite& site);

 private:
  const StreamView& stream_;
  MotionTilePlace place_{-1, {}, 0, 0, 0};
  Result<void> read_;  // the tile at place_
  MotionField field_;
};

/// The disparities that one motion plane of one reference image holds (MOT-6). Each motion tile is
/// read when one of its disparities is first asked for. Thread-safe.
class DisparityPlane {
 public:
  /// Takes the disparities of `motion_plane` of reference image `image` of level `level`; `stream`
  /// must outlive it.
  DisparityPlane(const StreamView& stream, int level, ImagePos image, size_t motion_plane);

  /// Stands for a disparity that cannot be read; none is as small.
  static constexpr int16_t kDamaged = INT16_MIN;

  /// Row gy of the plane's grid blocks, of which columns [first, last] have a meaning: disparities
  /// in [-4096, 4095], or kDamaged.
  const int16_t* row(uint32_t first, uint32_t last, uint32_t gy) const {
    const uint32_t ty = gy >> tile_log2_;
    for (uint32_t tx = first >> tile_log2_; tx <= last >> tile_log2_; ++tx) {
      read_.fill_once(size_t{ty} * tiles_x_ + tx, [&] { fill_tile(tx, ty); });
    }
    return values_.data() + size_t{gy} * columns_;
  }

  /// The disparity of a grid block of the plane; nothing where it cannot be read.
  std::optional<int32_t> find(const GridBlock& block) const {
    const int16_t value = row(block.gx, block.gx, block.gy)[block.gx];
    if (value == kDamaged) return std::nullopt;
    return value;
  }

  /// Bytes held.
  size_t bytes() const { return values_.capacity() * sizeof(int16_t); }

 private:
  void fill_tile(uint32_t tx, uint32_t ty) const;

  const StreamView& stream_;
  MotionTilePlace place_;  // with the tile 0, 0
  uint32_t columns_;
  uint32_t tiles_x_;
  unsigned tile_log2_;                   // grid blocks along a motion tile
  mutable std::vector<int16_t> values_;  // of the plane, row by row
  mutable FilledParts read_;             // by motion tile
};

}  // namespace hmlfc
