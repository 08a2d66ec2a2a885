// Models as sets what the GPU renderer holds of earlier frames: the rule of docs/gpu.md.
#pragma once

#include <cstdint>
#include <set>

#include <hmlfc/camera.hpp>

#include "render/displaced_cells.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// Predicts what frames decode. Blocks are numbered in the order of NED-2, 32 of them to a page.
class CacheModel {
 public:
  /// `budget`: bytes of pages that are kept between frames.
  CacheModel(const StreamView& stream, uint64_t budget);

  /// Takes a frame down to `stop_level`, with these displacements, and says how many blocks it
  /// decodes.
  uint64_t take(const FrameRecord& record, int stop_level, const CellDisplacements& displaced);

  /// Drops everything.
  void forget() {
    held_.clear();
    used_pages_ = 0;
  }

 private:
  using Blocks = std::set<uint64_t>;

  Blocks needed_blocks(const FrameRecord& record, const CellDisplacements& displaced) const;
  uint64_t block_number(ImagePos image, Plane plane, int32_t x, int32_t y) const;

  const StreamHeader header_;
  const Geometry geometry_;
  const uint64_t kept_pages_;
  int stop_level_ = 0;
  Blocks held_;
  uint64_t used_pages_ = 0;
};

}  // namespace hmlfc::gpu
