// A stream on its device, and the kernels that draw frames of it: what rendering by the library and
// recording for others share.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <hmlfc/gpu/renderer.hpp>

#include "batch_buffers.hpp"
#include "block_pool.hpp"
#include "device_stream.hpp"
#include "frame_buffers.hpp"
#include "recorder.hpp"

namespace hmlfc::gpu {

struct StreamRenderer {
  StreamRenderer(Device::State& d, const StreamView& view, uint64_t cache_bytes);

  /// What the commands of the frame of `record`, which fits the light field, depend on. Waits for
  /// the maps of the first one with geometry.
  FrameForm form_of(const FrameRecord& record, int stop_level);

  /// Makes room for `requests` requests and `pages` pages of the pool. No frame may be under way on
  /// the device.
  void make_room(uint64_t requests, uint64_t pages);

  /// Records the upload and the kernels of a frame of `form` in `frame`, which was prepared for it,
  /// and writes the part of its shape that all frames share. The picture is not ordered before
  /// anything behind it.
  void record(Recorder& commands, FrameBuffers& frame, const FrameForm& form);

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
  void describe(FrameShape& shape, uint32_t stop_level) const;

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
};

/// What a GpuRenderer offers to the other files of this folder.
struct GpuRendererAccess {
  /// Lives as long as any copy of it.
  static std::shared_ptr<StreamRenderer> stream(const GpuRenderer& renderer);
};

}  // namespace hmlfc::gpu
