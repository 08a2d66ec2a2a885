#include "stream_decoder.hpp"

#include <algorithm>

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kMinBlocks = 3;  // a block in RGB

}  // namespace

StreamDecoder::StreamDecoder(Device::State& d, const StreamView& view)
    : device(d), stream(d, view), header(view.header), sizes(block_sizes(view.header)) {
  device.kernels->prepare(KernelUse::kBlocks, stream.chunked());
}

uint64_t StreamDecoder::limit(bool trace) const {
  return std::max(kMinBlocks, std::min(max_requests(device, sizes, trace), max_blocks));
}

void StreamDecoder::record(Recorder& commands, const Batch& batch, KernelUse use,
                           const Arguments& arguments) const {
  const Variant plain = variant_of(KernelUse::kBlocks, stream.chunked());
  const Variant own = variant_of(use, stream.chunked());
  commands.dispatch("expand", plain, arguments, batch.requests);
  commands.barrier(kCompute, kCompute);
  commands.dispatch("walk", plain, arguments, batch.requests * sizes.levels);
  commands.barrier(kCompute, kCompute);
  commands.dispatch("samples", use == KernelUse::kStages ? own : plain, arguments,
                    batch.requests * sizes.lanes());
  if (batch.pixels == 0) return;
  commands.barrier(kCompute, kCompute);
  commands.dispatch("colour", own, arguments, batch.pixels * sizes.lanes());
}

}  // namespace hmlfc::gpu
