#include <hmlfc/gpu/decoder.hpp>

#include <algorithm>
#include <cstring>
#include <iterator>

#include <hmlfc/error.hpp>

#include "arithmetic/rounding.hpp"
#include "decoder/open_stream.hpp"
#include "decoder_state.hpp"
#include "device/submission.hpp"
#include "stage_times.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kMinBlocks = 3;  // of a submission: a block in RGB

// block_entry.glsl
enum EntryKind : uint32_t { kKindNone = 0, kKindKey = 1 };
// samples.comp
enum Stage : uint32_t { kResidual = 0, kReference = 1, kPrediction = 2, kSample = 3 };

uint32_t bits(uint32_t word, unsigned at, unsigned count) {
  return (word >> at) & ((1u << count) - 1);
}

SubpelVector vector_of(uint32_t word) {
  return {sign_extend(bits(word, 0, 10), 10), sign_extend(bits(word, 10, 10), 10),
          static_cast<int32_t>(bits(word, 20, 3)), static_cast<int32_t>(bits(word, 24, 3))};
}

std::vector<int16_t> unpack(std::span<const uint32_t> words) {
  std::vector<int16_t> samples;
  for (const uint32_t word : words) {
    samples.push_back(static_cast<int16_t>(word));
    samples.push_back(static_cast<int16_t>(word >> 16));
  }
  return samples;
}

LevelStages level_stages(int level, std::span<const uint32_t> entry) {
  const uint32_t head = entry[0];
  LevelStages stages;
  stages.level = level;
  stages.status = static_cast<uint8_t>(head);
  stages.key = bits(head, 8, 2) == kKindKey;
  stages.references = bits(head, 10, 2);
  stages.negative = bits(head, 12, 1) != 0;
  stages.has_residual = bits(head, 13, 1) != 0;
  for (size_t i = 0; i < 2; ++i) stages.vectors[i] = vector_of(entry[4 + 2 * i]);
  return stages;
}

// The stages of one block, whose status is `status`. `entries` begins with its entries
// (block_entry.glsl), `stages` with its stages (samples.comp).
BlockStages block_stages(uint32_t status, std::span<const uint32_t> entries,
                         std::span<const uint32_t> stages, const BlockSizes& sizes) {
  BlockStages block;
  block.status = static_cast<uint8_t>(status);
  if (status == static_cast<uint32_t>(ErrorCode::kBadRequest)) return block;
  for (uint32_t l = sizes.levels; l-- > 0;) {
    const auto entry = entries.subspan(l * kEntryWords, kEntryWords);
    if (bits(entry[0], 8, 2) == kKindNone) continue;
    LevelStages level = level_stages(static_cast<int>(l), entry);
    const auto values = [&](Stage stage) {
      return unpack(
          stages.subspan((l * kStageCount + stage) * sizes.sample_words, sizes.sample_words));
    };
    const bool failed = level.status != 0;
    if (!failed) {
      if (level.has_residual) level.residual = values(kResidual);
      if (level.references != 0) level.reference = values(kReference);
      if (!level.key) level.prediction = values(kPrediction);
      level.sample = values(kSample);
    }
    block.levels.push_back(std::move(level));
    if (failed) break;
  }
  return block;
}

}  // namespace

GpuDecoder::State::State(Device::State& d, const StreamView& view)
    : device(d), stream(d, view), header(view.header), sizes(block_sizes(view.header)) {
  device.kernels->prepare(KernelUse::kBlocks, stream.chunked());
}

uint64_t GpuDecoder::State::limit(bool trace) const {
  return std::max(kMinBlocks, std::min(max_requests(device, sizes, trace), max_blocks));
}

void GpuDecoder::State::write(Commands& commands, const Batch& batch, KernelUse use,
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

const Buffer& GpuDecoder::State::run(const Batch& batch, KernelUse use,
                                     std::initializer_list<Output> outputs) {
  uint64_t bytes = 0;
  for (const Output& output : outputs) bytes += output.bytes;
  const Arguments arguments = buffers.prepare(device, batch, sizes, use, stream.arguments());
  const Buffer& readback = buffers.readback.reserve(device, bytes);
  Submission commands(device);
  commands.barrier(kTransfer, kCompute);  // the stream's upload
  write(commands, batch, use, arguments);
  commands.barrier(kCompute, kTransfer);
  uint64_t at = 0;
  for (const Output& output : outputs) {
    commands.copy(output.buffer.get(), 0, readback, at, output.bytes);
    at += output.bytes;
  }
  commands.barrier(kTransfer, kHost);
  commands.read_by_host(readback);
  add_times(commands.run(), times);
  return readback;
}

void GpuDecoder::State::decode(const Batch& batch, Blocks& result) {
  const bool rgb = batch.pixels != 0;
  const auto count = static_cast<size_t>(rgb ? batch.pixels : batch.requests);
  const auto bytes = static_cast<size_t>(count * sizes.sample_bytes() * (rgb ? 3 : 1));
  const Buffer& read = run(batch, KernelUse::kBlocks,
                           {{rgb ? buffers.pixel_statuses : buffers.statuses, 4 * count},
                            {rgb ? buffers.pixels : buffers.samples, bytes}});
  const auto words = read.records<const uint32_t>();
  std::ranges::transform(words.first(count), std::back_inserter(result.statuses),
                         [](uint32_t word) { return static_cast<uint8_t>(word); });
  const size_t before = result.samples.size();
  result.samples.resize(before + bytes / sizeof(int16_t));
  std::memcpy(result.samples.data() + before, words.data() + count, bytes);
}

void GpuDecoder::State::trace(const Batch& batch, std::vector<BlockStages>& result) {
  const auto requests = static_cast<size_t>(batch.requests);
  const Buffer& read = run(batch, KernelUse::kStages,
                           {{buffers.statuses, 4 * batch.requests},
                            {buffers.entries, batch.requests * sizes.entry_bytes()},
                            {buffers.stages, batch.requests * sizes.stage_bytes()}});
  const auto words = read.records<const uint32_t>();
  for (size_t q = 0; q < requests; ++q) {
    const size_t entries = requests + q * sizes.levels * kEntryWords;
    const size_t stages = requests + requests * sizes.levels * kEntryWords +
                          q * static_cast<size_t>(sizes.stage_bytes()) / 4;
    result.push_back(block_stages(words[q], words.subspan(entries), words.subspan(stages), sizes));
  }
}

Outcome<GpuDecoder> GpuDecoder::open(Device& device, const StreamView& stream) {
  return guard_device([&] { return GpuDecoder(std::make_shared<State>(device.state(), stream)); });
}

Outcome<GpuDecoder> GpuDecoder::open(Device& device, const Decoder& stream) {
  return open(device, DecoderAccess::stream(stream));
}

Outcome<Blocks> GpuDecoder::decode(std::span<const BlockArea> areas) {
  return guard_device([&] {
    state_->times.clear();
    Blocks blocks;
    for (const Batch& batch : batches_of(areas, state_->limit(false))) {
      state_->decode(batch, blocks);
    }
    return blocks;
  });
}

Outcome<PixelBlocks> GpuDecoder::decode_rgb(std::span<const PixelArea> areas) {
  return guard_device([&] {
    state_->times.clear();
    PixelBlocks blocks;
    for (const Batch& batch :
         batches_of(areas, state_->header.chroma_format, state_->limit(false))) {
      state_->decode(batch, blocks);
    }
    return blocks;
  });
}

Outcome<std::vector<BlockStages>> GpuDecoder::trace(std::span<const BlockArea> areas) {
  return guard_device([&] {
    state_->times.clear();
    state_->device.kernels->prepare(KernelUse::kStages, state_->stream.chunked());
    std::vector<BlockStages> blocks;
    for (const Batch& batch : batches_of(areas, state_->limit(true))) state_->trace(batch, blocks);
    return blocks;
  });
}

const std::vector<StageTime>& GpuDecoder::stage_times() const { return state_->times; }

uint64_t GpuDecoder::reference_bytes() const { return state_->stream.reference_bytes(); }

void GpuDecoder::limit_submissions(uint64_t blocks) { state_->max_blocks = blocks; }

}  // namespace hmlfc::gpu
