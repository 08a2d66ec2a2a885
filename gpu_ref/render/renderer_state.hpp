// A renderer: a stream on its device, and what its frames share.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/gpu/renderer.hpp>

#include "block_pool.hpp"
#include "decode/batch.hpp"
#include "decode/device_stream.hpp"
#include "device/commands.hpp"
#include "frame_buffers.hpp"
#include "frame_ring.hpp"

namespace hmlfc::gpu {

struct GpuRenderer::State {
  State(Device::State& d, const StreamView& view, uint64_t cache_bytes);

  /// Returns what the commands of the frame of `record`, which fits the light field, depend on.
  /// The first frame with geometry waits for the upload of the disparity maps.
  FrameForm form_of(const FrameRecord& record, int stop_level);

  /// Makes room for `requests` requests and `pages` pages of the pool. No frame may be under way on
  /// the device.
  void make_room(uint64_t requests, uint64_t pages);

  /// Writes the upload and the kernels of a frame of `form` with the buffers `frame`, which are
  /// prepared for it, and sets those of its arguments that all frames share. The caller orders the
  /// picture before what follows.
  void write(Commands& commands, FrameBuffers& frame, const FrameForm& form);

  Device::State& device;
  DeviceStream stream;
  StreamView source;
  StreamHeader header;
  Geometry geometry;
  BlockSizes sizes;
  BlockPool pool;

 private:
  void make_bits(GrowingBuffer& bits);
  void prepare_geometry();
  uint64_t words_of_level(int level) const;
  void describe(FrameArguments& frame, uint32_t stop_level) const;

  uint64_t capacity_ = 0;
  uint64_t room_ = 0;      // counts make_room()
  bool has_room_ = false;  // and the last one did not fail
  BatchBuffers buffers_;
  Arguments arguments_;
  GrowingBuffer needed_{Memory::kDevice};
  GrowingBuffer looked_up_{Memory::kDevice};
  std::optional<Buffer> disparities_;  // once a frame has geometry
  GrowingBuffer slot_numbers_{Memory::kDevice};
  GrowingBuffer dispatches_{Memory::kDevice};

 public:
  FrameRing ring;  // the first to be destroyed
};

}  // namespace hmlfc::gpu
