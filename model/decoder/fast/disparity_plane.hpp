// The disparities of one reference image, a motion tile at a time, equal to read_disparity on each.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "syntax/disparity_tile.hpp"

namespace hmlfc {

/// The disparities that one motion plane of one reference image holds (MOT-6). Each motion tile is
/// read when one of its disparities is first asked for. Thread-safe.
class DisparityPlane {
 public:
  /// Those of `motion_plane` of reference image `image` of level `level`; `stream` must outlive it.
  static DisparityPlane open(const StreamView& stream, int level, ImagePos image,
                             size_t motion_plane);

  /// The disparity of a grid block of the plane; nothing where it cannot be read.
  std::optional<int32_t> find(const GridBlock& block) const {
    const size_t tile = size_t{block.gy >> tile_log2_} * tiles_x_ + (block.gx >> tile_log2_);
    if (!state_->ready[tile].load(std::memory_order_acquire)) read_tile(tile);
    const int16_t value = state_->values[size_t{block.gy} * columns_ + block.gx];
    if (value == kDamaged) return std::nullopt;
    return value;
  }

  /// Bytes held.
  size_t bytes() const { return state_->values.capacity() * sizeof(int16_t); }

 private:
  static constexpr int16_t kDamaged = INT16_MIN;  // no disparity is as small

  struct State {
    explicit State(size_t tiles) : ready(tiles) {}

    std::mutex mutex;                      // of whoever reads a tile
    std::vector<std::atomic<bool>> ready;  // by motion tile: its values are there
    std::vector<int16_t> values;           // of the plane, row by row
  };

  void read_tile(size_t tile) const;
  void fill_tile(const MotionTilePlace& place) const;

  const StreamView* stream_ = nullptr;
  int level_ = 0;
  ImagePos image_;
  size_t motion_plane_ = 0;
  uint32_t columns_ = 0;
  uint32_t tiles_x_ = 0;
  unsigned tile_log2_ = 0;  // grid blocks along a motion tile
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc
