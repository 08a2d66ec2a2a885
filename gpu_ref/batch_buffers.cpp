#include "batch_buffers.hpp"

#include <algorithm>

namespace hmlfc::gpu {
namespace {

template <class Record>
uint64_t write_records(Device::State& device, GrowingBuffer& buffer,
                       const std::vector<Record>& records) {
  Buffer& target = buffer.reserve(device, records.size() * sizeof(Record));
  std::ranges::copy(records, target.records<Record>().begin());
  return target.address();
}

}  // namespace

Arguments BatchBuffers::prepare(Device::State& device, const Batch& batch, const BlockSizes& sizes,
                                bool trace, Arguments arguments) {
  arguments.areas = write_records(device, areas, batch.areas);
  arguments.area_count = static_cast<uint32_t>(batch.areas.size());
  arguments.request_count = static_cast<uint32_t>(batch.requests);
  arguments.requests = requests.reserve(device, batch.requests * kRequestBytes).address();
  arguments.entries = entries.reserve(device, batch.requests * sizes.entry_bytes()).address();
  arguments.statuses = statuses.reserve(device, batch.requests * 4).address();
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
