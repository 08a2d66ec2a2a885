// The decoder on a Vulkan device: areas of blocks in, samples or pixels out.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/gpu/device.hpp>

namespace hmlfc {
struct StreamView;
}

namespace hmlfc::gpu {

struct BlockStages;

/// A rectangle of blocks of one plane of one view; one block is 1 x 1. A block that the stream does
/// not have gets bad_request.
struct BlockArea {
  ViewPos view;
  Plane plane = Plane::kY;
  uint32_t bx = 0;  ///< first block, [0, 2^31 - 1]
  uint32_t by = 0;
  uint32_t columns = 1;  ///< [1, 2^31]
  uint32_t rows = 1;
  int stop_level = 0;  ///< level s of DEC-1
};

/// A rectangle of blocks of plane Y, wanted as pixels in RGB.
struct PixelArea {
  ViewPos view;
  uint32_t bx = 0;
  uint32_t by = 0;
  uint32_t columns = 1;
  uint32_t rows = 1;
  int stop_level = 0;
};

/// Decoded blocks, area by area, in each row by row.
struct Blocks {
  std::vector<uint8_t> statuses;  ///< errors of annex A, 0 for none; one a block
  std::vector<int16_t> samples;   ///< B * B a block, all 0 with an error
};

/// Decoded pixels: three lanes of B * B a block, R, G and B.
using PixelBlocks = Blocks;

/// Time on the device of one stage of the last call, all submissions together.
struct StageTime {
  std::string stage;  ///< "expand", "walk", "samples" or "colour"
  double seconds = 0;
};

/// Decodes one stream. The device must outlive it.
class GpuDecoder {
 public:
  /// Uploads the stream, decodes its key images on the host and its other reference images on the
  /// device. Blocks of key images that do not decode have the error of their image. Nothing of
  /// `stream`, nor its bytes, is needed afterwards.
  ///
  /// A partial ByteSource is asked for parts of DeviceOptions::upload_bytes, and for 16 key images
  /// at a time, and may drop each before the next; Decoder::open asks it for all bytes at once
  /// unless OpenOptions::check_sections is false. kSource where it fails.
  static Outcome<GpuDecoder> open(Device& device, const Decoder& stream);

  /// The same, for this project's own programs.
  static Outcome<GpuDecoder> open(Device& device, const StreamView& stream);

  /// Decodes all blocks of `areas`: one submission, or several where they do not fit in one.
  Outcome<Blocks> decode(std::span<const BlockArea> areas);

  /// Decodes to pixels in the same way. The status is that of Y, Co or Cg, in this order.
  Outcome<PixelBlocks> decode_rgb(std::span<const PixelArea> areas);

  /// Decodes blocks with every stage, by the debug variant of the kernels, for this project's own
  /// programs (block_stages.hpp).
  Outcome<std::vector<BlockStages>> trace(std::span<const BlockArea> areas);

  /// Times of the last call; empty where the device has no timestamps.
  const std::vector<StageTime>& stage_times() const;

  /// Returns the bytes of the reference area.
  uint64_t reference_bytes() const;

  /// Most blocks of one submission; for tests. [1, 2^24]
  void limit_submissions(uint64_t blocks);

  /// For this project's own files (decoder_state.hpp).
  struct State;
  explicit GpuDecoder(std::shared_ptr<State> state) : state_(std::move(state)) {}
  const std::shared_ptr<State>& state() const { return state_; }

 private:
  std::shared_ptr<State> state_;  // of all copies
};

}  // namespace hmlfc::gpu
