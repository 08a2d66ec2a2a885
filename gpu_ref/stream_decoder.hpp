// A stream on its device, and the kernels that decode areas of it: what decoding by the library and
// recording for others share.
#pragma once

#include <cstdint>
#include <memory>

#include <hmlfc/gpu/decoder.hpp>

#include "batch_buffers.hpp"
#include "device_stream.hpp"
#include "recorder.hpp"

namespace hmlfc::gpu {

struct StreamDecoder {
  StreamDecoder(Device::State& d, const StreamView& view);

  /// Most requests of a submission that leaves stages or not.
  uint64_t limit(bool trace) const;

  /// Records the kernels of `batch` with barriers between them, and none before or behind. `use` as
  /// for BatchBuffers::prepare, which made `arguments`.
  void record(Recorder& commands, const Batch& batch, KernelUse use,
              const Arguments& arguments) const;

  Device::State& device;
  DeviceStream stream;
  StreamHeader header;
  BlockSizes sizes;
  uint64_t max_blocks = ~uint64_t{0};
};

/// What a GpuDecoder offers to the other files of this folder.
struct GpuDecoderAccess {
  /// Lives as long as any copy of it.
  static std::shared_ptr<const StreamDecoder> stream(const GpuDecoder& decoder);
};

}  // namespace hmlfc::gpu
