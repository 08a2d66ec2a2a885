// Areas of blocks in submissions that are not too large.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arguments.hpp"
#include "gpu_decoder.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// What one submission decodes.
struct Batch {
  std::vector<AreaRecord> areas;
  uint64_t requests = 0;
  std::vector<ColourAreaRecord> colour_areas;
  uint64_t pixels = 0;  ///< blocks in RGB

  /// Appends `rows` rows of blocks.
  void add(const AreaRecord& area, uint32_t rows);
};

/// The blocks of `areas` in their order, at most `limit` requests a batch, limit >= 1. Areas are
/// cut where they do not fit.
std::vector<Batch> batches_of(std::span<const BlockArea> areas, uint64_t limit);

/// The same for pixels, with the chroma blocks that they need; limit >= 3.
std::vector<Batch> batches_of(std::span<const PixelArea> areas, ChromaFormat format,
                              uint64_t limit);

/// The blocks of all reference images of levels that are not keyed (DEC-4), cut in the same way.
std::vector<Batch> reference_batches(const Geometry& geometry, uint64_t limit);

}  // namespace hmlfc::gpu
