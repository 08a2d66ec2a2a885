#include <hmlfc/gpu/recording.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "commands.hpp"
#include "image_region.hpp"
#include "stream_decoder.hpp"

namespace hmlfc::gpu {

struct Recording::State {
  std::shared_ptr<const StreamDecoder> decoder;
  uint64_t blocks = 0;
  BatchBuffers buffers;
};

namespace {

// `areas` as one batch; none for no areas.
std::vector<Batch> batch_of(const StreamDecoder& decoder, std::span<const PixelArea> areas) {
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

// One run: before it, work of an earlier one may still be under way. `copy(commands, texels,
// bytes)` brings the texels to their target.
template <class Copy>
void record_run(Recorder& commands, const StreamDecoder& decoder, const Batch& batch,
                const Arguments& arguments, const BatchBuffers& buffers, const Copy& copy) {
  const Buffer& statuses = buffers.readback.get();
  commands.barrier(kCompute | kTransfer, kCompute | kTransfer);
  decoder.record(commands, batch, KernelUse::kTexels, arguments);
  commands.barrier(kCompute, kTransfer);
  copy(commands, buffers.pixels.get(), batch.texels * decoder.sizes.texel_bytes);
  commands.copy(buffers.pixel_statuses.get(), 0, statuses, 0, statuses.size());
  commands.barrier(kTransfer, kHost);
}

template <class Copy>
std::unique_ptr<Recording::State> record_batch(const GpuDecoder& gpu_decoder,
                                               VkCommandBuffer target,
                                               std::span<const PixelArea> areas, const Copy& copy) {
  auto state = std::make_unique<Recording::State>();
  state->decoder = GpuDecoderAccess::stream(gpu_decoder);
  const StreamDecoder& decoder = *state->decoder;
  Device::State& device = usable(decoder.device);
  const auto batches = batch_of(decoder, areas);
  if (batches.empty()) return state;
  const Batch& batch = batches.front();
  device.kernels->prepare(KernelUse::kTexels, decoder.stream.chunked());
  state->blocks = batch.pixels;
  BatchBuffers& buffers = state->buffers;
  const Arguments arguments =
      buffers.prepare(device, batch, decoder.sizes, KernelUse::kTexels, decoder.stream.arguments());
  buffers.readback.reserve(device, 4 * batch.pixels);
  const auto record_to = [&](Recorder& commands) {
    record_run(commands, decoder, batch, arguments, buffers, copy);
  };
  // The check of barriers sees two runs: the commands may be submitted again and again.
  if (device.hazards) {
    Recorder earlier(device, vk::CommandBuffer());
    record_to(earlier);
  }
  Recorder commands(device, target);
  record_to(commands);
  commands.read_by_host(buffers.readback.get());
  commands.check();
  return state;
}

std::vector<vk::BufferImageCopy> regions_of(std::span<const PixelArea> areas,
                                            const StreamHeader& header, const ImageTarget& target) {
  std::vector<vk::BufferImageCopy> regions;
  uint64_t offset = 0;
  for (size_t i = 0; i < areas.size(); ++i) {
    const VkExtent2D extent = texel_extent(areas[i], header);
    if (extent.width == 0 || extent.height == 0) continue;
    regions.push_back(region_of(target, i, offset, extent));
    offset += uint64_t{texel_bytes(header)} * extent.width * extent.height;
  }
  return regions;
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
  return guard_device([&] {
    const auto copy = [&](Recorder& recorder, const Buffer& texels, uint64_t bytes) {
      recorder.copy_out(texels, bytes, target.buffer, target.offset);
    };
    return Recording(record_batch(decoder, commands, areas, copy));
  });
}

Outcome<Recording> record(const GpuDecoder& decoder, VkCommandBuffer commands,
                          std::span<const PixelArea> areas, const ImageTarget& target) {
  return guard_device([&] {
    if (target.places.size() != areas.size()) {
      throw MachineError(FailureKind::kLimit,
                         "ImageTarget::places has " + std::to_string(target.places.size()) +
                             " places for " + std::to_string(areas.size()) + " areas");
    }
    const auto regions = regions_of(areas, GpuDecoderAccess::stream(decoder)->header, target);
    const auto copy = [&](Recorder& recorder, const Buffer& texels, uint64_t) {
      recorder.copy_out(texels, target.image, vk::ImageLayout(target.layout), regions);
    };
    return Recording(record_batch(decoder, commands, areas, copy));
  });
}

}  // namespace hmlfc::gpu
