// Batches: which blocks a submission decodes, and its buffers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "device/arguments.hpp"
#include "device/buffer.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// What one submission decodes.
struct Batch {
  std::vector<AreaRecord> areas;
  uint64_t requests = 0;
  std::vector<ColourAreaRecord> colour_areas;
  uint64_t pixels = 0;  ///< blocks in RGB
  uint64_t texels = 0;  ///< after number_texels()

  /// Appends `rows` rows of blocks.
  void add(const AreaRecord& area, uint32_t rows);
};

/// Returns the blocks of `areas` in their order, at most `limit` requests a batch, limit >= 1.
/// Areas that do not fit are cut.
std::vector<Batch> batches_of(std::span<const BlockArea> areas, uint64_t limit);

/// Returns the blocks of pixels, with the chroma blocks that they need, likewise; limit >= 3.
std::vector<Batch> batches_of(std::span<const PixelArea> areas, ChromaFormat format,
                              uint64_t limit);

/// Returns the pixels of `area` inside its view: columns, rows.
std::array<uint32_t, 2> pixels_of(const PixelArea& area, const StreamHeader& header);

/// Numbers the texels of `areas`, of which `batch` was made alone and not cut: area by area, each
/// row by row (texels.glsl).
void number_texels(std::span<const PixelArea> areas, const StreamHeader& header, Batch& batch);

/// Returns the blocks of all reference images of levels that are not keyed (DEC-4), cut likewise.
std::vector<Batch> reference_batches(const Geometry& geometry, uint64_t limit);

/// Sizes that follow from the stream.
struct BlockSizes {
  uint32_t levels = 1;        ///< entries of a request
  uint32_t sample_words = 8;  ///< words of a block's samples
  uint32_t texel_bytes = 4;   ///< texels.glsl

  /// Invocations that make its samples (block_lanes.glsl).
  uint32_t lanes() const { return sample_words < 4 ? 1 : sample_words / 4; }

  uint64_t entry_bytes() const { return uint64_t{levels} * kEntryWords * 4; }
  uint64_t sample_bytes() const { return uint64_t{sample_words} * 4; }
  uint64_t stage_bytes() const { return levels * kStageCount * sample_bytes(); }
};

/// Returns the sizes of a stream with this header.
BlockSizes block_sizes(const StreamHeader& header);

/// Returns the most requests of one submission, with stages or without.
uint64_t max_requests(const Device::State& device, const BlockSizes& sizes, bool trace);

/// What one submission reads and writes besides the stream.
struct BatchBuffers {
  GrowingBuffer areas{Memory::kUpload};
  GrowingBuffer colour_areas{Memory::kUpload};
  GrowingBuffer requests{Memory::kDevice};
  GrowingBuffer entries{Memory::kDevice};
  GrowingBuffer statuses{Memory::kDevice};
  GrowingBuffer samples{Memory::kDevice};
  GrowingBuffer stages{Memory::kDevice};
  GrowingBuffer pixels{Memory::kDevice};
  GrowingBuffer pixel_statuses{Memory::kDevice};
  GrowingBuffer readback{Memory::kReadback};

  /// Makes room for `count` requests and what walks make of them, and returns `arguments` with it.
  Arguments prepare_requests(Device::State& device, uint64_t count, const BlockSizes& sizes,
                             Arguments arguments);

  /// Writes the areas of `batch`, makes room for its results, and returns the completed
  /// `arguments`. `use`: kBlocks; kStages, to have the stages as well; kTexels, to have texels
  /// instead of lanes.
  Arguments prepare(Device::State& device, const Batch& batch, const BlockSizes& sizes,
                    KernelUse use, Arguments arguments);
};

}  // namespace hmlfc::gpu
