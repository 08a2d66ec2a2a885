#include <hmlfc/gpu/recording.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "decoder_state.hpp"
#include "device/submission.hpp"
#include "texel_target.hpp"

namespace hmlfc::gpu {

struct Recording::State {
  std::shared_ptr<const GpuDecoder::State> decoder;
  uint64_t blocks = 0;
  BatchBuffers buffers;
};

namespace {

// `areas` as one batch; none for no areas.
std::vector<Batch> batch_of(const GpuDecoder::State& decoder, std::span<const PixelArea> areas) {
  const uint64_t limit = decoder.limit(false);
  auto batches = batches_of(areas, decoder.header.chroma_format, limit);
  if (batches.size() > 1) {
    throw MachineError(FailureKind::kLimit,
                       "the areas are more blocks than one recording can have, " +
                           std::to_string(limit / 3) + " of plane Y: record fewer at a time");
  }
  if (!batches.empty()) number_texels(areas, decoder.header, batches.front());
  return batches;
}

// Writes one run. Work of an earlier run may still be under way before it.
void write_run(Commands& commands, const GpuDecoder::State& decoder, const Batch& batch,
               const Arguments& arguments, const BatchBuffers& buffers, const TexelTarget& target) {
  const Buffer& statuses = buffers.readback.get();
  commands.barrier(kCompute | kTransfer, kCompute | kTransfer);
  decoder.write(commands, batch, KernelUse::kTexels, arguments);
  commands.barrier(kCompute, kTransfer);
  target.write(commands, buffers.pixels.get(), batch.texels * decoder.sizes.texel_bytes);
  commands.copy(buffers.pixel_statuses.get(), 0, statuses, 0, statuses.size());
  commands.barrier(kTransfer, kHost);
}

Recording record_batch(const GpuDecoder& gpu_decoder, VkCommandBuffer handle,
                       std::span<const PixelArea> areas, const TexelTarget& target) {
  auto state = std::make_unique<Recording::State>();
  state->decoder = gpu_decoder.state();
  const GpuDecoder::State& decoder = *state->decoder;
  Device::State& device = usable(decoder.device);
  const auto batches = batch_of(decoder, areas);
  if (batches.empty()) return Recording(std::move(state));
  const Batch& batch = batches.front();
  device.kernels->prepare(KernelUse::kTexels, decoder.stream.chunked());
  state->blocks = batch.pixels;
  BatchBuffers& buffers = state->buffers;
  const Arguments arguments =
      buffers.prepare(device, batch, decoder.sizes, KernelUse::kTexels, decoder.stream.arguments());
  buffers.readback.reserve(device, 4 * batch.pixels);
  // The check of barriers sees two runs: the commands may be submitted again and again.
  if (device.hazards) {
    Commands earlier(device, vk::CommandBuffer());
    write_run(earlier, decoder, batch, arguments, buffers, target);
  }
  Commands commands(device, handle);
  write_run(commands, decoder, batch, arguments, buffers, target);
  commands.read_by_host(buffers.readback.get());
  commands.check();
  return Recording(std::move(state));
}

std::vector<VkExtent2D> extents_of(std::span<const PixelArea> areas, const StreamHeader& header) {
  std::vector<VkExtent2D> extents;
  for (const PixelArea& area : areas) extents.push_back(texel_extent(area, header));
  return extents;
}

}  // namespace

uint32_t texel_bytes(const StreamHeader& header) { return block_sizes(header).texel_bytes; }

VkExtent2D texel_extent(const PixelArea& area, const StreamHeader& header) {
  const auto [columns, rows] = pixels_of(area, header);
  return {columns, rows};
}

Recording::Recording(std::unique_ptr<State> state) : state_(std::move(state)) {}
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;
Recording::~Recording() = default;

std::vector<uint8_t> Recording::statuses() const {
  std::vector<uint8_t> statuses;
  if (state_->blocks == 0) return statuses;
  const auto words = state_->buffers.readback.get().records<const uint32_t>();
  std::ranges::transform(words.first(static_cast<size_t>(state_->blocks)),
                         std::back_inserter(statuses),
                         [](uint32_t word) { return static_cast<uint8_t>(word); });
  return statuses;
}

Outcome<Recording> record(const GpuDecoder& decoder, VkCommandBuffer commands,
                          std::span<const PixelArea> areas, const BufferTarget& target) {
  return guard_device([&] { return record_batch(decoder, commands, areas, TexelTarget(target)); });
}

Outcome<Recording> record(const GpuDecoder& decoder, VkCommandBuffer commands,
                          std::span<const PixelArea> areas, const ImageTarget& target) {
  return guard_device([&] {
    const StreamHeader& header = decoder.state()->header;
    const TexelTarget places(target, extents_of(areas, header), texel_bytes(header),
                             std::to_string(areas.size()) + " areas");
    return record_batch(decoder, commands, areas, places);
  });
}

}  // namespace hmlfc::gpu
