#include "batch_buffers.hpp"

#include <algorithm>

#include "commands.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kMaxRequests = uint64_t{1} << 24;

template <class Record>
uint64_t write_records(Device::State& device, GrowingBuffer& buffer,
                       const std::vector<Record>& records) {
  Buffer& target = buffer.reserve(device, records.size() * sizeof(Record));
  std::ranges::copy(records, target.records<Record>().begin());
  return target.address();
}

}  // namespace

BlockSizes block_sizes(const StreamHeader& header) {
  return {static_cast<uint32_t>(header.tree_height) + 1,
          header.block_size() * header.block_size() / 2};
}

uint64_t most_requests(const Device::State& device, const BlockSizes& sizes, bool trace) {
  // A status and the samples twice, on the device and on the host; three lanes of pixels.
  const uint64_t bytes = kRequestBytes + sizes.entry_bytes() + 8 + 4 * sizes.sample_bytes() +
                         (trace ? 2 * sizes.stage_bytes() : 0);
  const uint64_t budget = std::min(kSubmissionBytes, device.max_buffer_bytes);
  const uint64_t invocations = kMaxInvocations / std::max(sizes.sample_words, sizes.levels);
  return std::min({budget / bytes, invocations, kMaxRequests});
}

Arguments BatchBuffers::prepare_requests(Device::State& device, uint64_t count,
                                         const BlockSizes& sizes, Arguments arguments) {
  arguments.request_count = static_cast<uint32_t>(count);
  arguments.requests = requests.reserve(device, count * kRequestBytes).address();
  arguments.entries = entries.reserve(device, count * sizes.entry_bytes()).address();
  arguments.statuses = statuses.reserve(device, count * 4).address();
  return arguments;
}

Arguments BatchBuffers::prepare(Device::State& device, const Batch& batch, const BlockSizes& sizes,
                                bool trace, Arguments arguments) {
  arguments = prepare_requests(device, batch.requests, sizes, arguments);
  arguments.areas = write_records(device, areas, batch.areas);
  arguments.area_count = static_cast<uint32_t>(batch.areas.size());
  arguments.samples = samples.reserve(device, batch.requests * sizes.sample_bytes()).address();
  if (trace) {
    arguments.stages = stages.reserve(device, batch.requests * sizes.stage_bytes()).address();
  }
  if (batch.pixels != 0) {
    arguments.colour_areas = write_records(device, colour_areas, batch.colour_areas);
    arguments.colour_area_count = static_cast<uint32_t>(batch.colour_areas.size());
    arguments.pixel_count = static_cast<uint32_t>(batch.pixels);
    arguments.pixels = pixels.reserve(device, batch.pixels * 3 * sizes.sample_bytes()).address();
    arguments.pixel_statuses = pixel_statuses.reserve(device, batch.pixels * 4).address();
  }
  return arguments;
}

}  // namespace hmlfc::gpu
