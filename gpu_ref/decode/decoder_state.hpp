// A decoder: a stream on its device, and the kernels that decode areas of it.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "batch.hpp"
#include "block_stages.hpp"
#include "device/commands.hpp"
#include "device_stream.hpp"

namespace hmlfc::gpu {

struct GpuDecoder::State {
  State(Device::State& d, const StreamView& view);

  /// Returns the most requests of a submission, with stages or without.
  uint64_t limit(bool trace) const;

  /// Writes the kernels of `batch` with barriers between them, and none before or after. `use` and
  /// `arguments` are those of BatchBuffers::prepare.
  void write(Commands& commands, const Batch& batch, KernelUse use,
             const Arguments& arguments) const;

  /// Decodes `batch` in one submission, and appends its statuses and samples, of blocks or pixels.
  void decode(const Batch& batch, Blocks& result);

  /// Decodes `batch` by the debug variant of the kernels, and appends the record of each block.
  void trace(const Batch& batch, std::vector<BlockStages>& result);

  Device::State& device;
  DeviceStream stream;
  StreamHeader header;
  BlockSizes sizes;
  uint64_t max_blocks = ~uint64_t{0};
  BatchBuffers buffers;
  std::vector<StageTime> times;  // of the last call

 private:
  /// The first bytes of a buffer, for the host.
  struct Output {
    const GrowingBuffer& buffer;
    uint64_t bytes;
  };

  /// Decodes `batch` in one submission. The buffer returned begins with its outputs, in order.
  const Buffer& run(const Batch& batch, KernelUse use, std::initializer_list<Output> outputs);
};

}  // namespace hmlfc::gpu
