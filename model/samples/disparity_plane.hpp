// The disparities of one reference image, read at once, equal to read_disparity on each.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fields/disparity_tile.hpp"

namespace hmlfc {

/// The disparities that one motion plane of one reference image holds (MOT-6). Immutable once
/// built.
class DisparityPlane {
 public:
  /// Reads every motion tile of `motion_plane` of reference image `image` of level `level`. Never
  /// fails: find has nothing where a disparity cannot be read.
  static DisparityPlane read(const StreamView& stream, int level, ImagePos image,
                             size_t motion_plane);

  /// The disparity of a grid block of the plane; nothing where it cannot be read.
  std::optional<int32_t> find(const GridBlock& block) const {
    const int16_t value = values_[size_t{block.gy} * columns_ + block.gx];
    if (value == kDamaged) return std::nullopt;
    return value;
  }

  /// Bytes held.
  size_t bytes() const { return values_.capacity() * sizeof(int16_t); }

 private:
  static constexpr int16_t kDamaged = INT16_MIN;  // no disparity is as small

  void read_tile(const StreamView& stream, const MotionTilePlace& place);

  uint32_t columns_ = 0;
  std::vector<int16_t> values_;  // row by row
};

}  // namespace hmlfc
