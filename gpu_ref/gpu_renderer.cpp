#include "gpu_renderer.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "arithmetic/rounding.hpp"
#include "batch_buffers.hpp"
#include "block_pool.hpp"
#include "commands.hpp"
#include "device_stream.hpp"
#include "frame_shape.hpp"
#include "render/shown_image.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kFirstCapacity = uint64_t{1} << 14;  // blocks
constexpr uint32_t kNoError = ~0u;
constexpr uint64_t kBitsOfWord = 32;
constexpr uint64_t kPixelsAtOnce = 2;  // of render.comp

// Blocks of all planes of one image.
uint64_t blocks_of_image(const Geometry& geometry) {
  uint64_t blocks = 0;
  for (const Plane plane : kPlanes) {
    const PlaneShape& shape = geometry.plane(plane);
    blocks += uint64_t{shape.blocks_x} * shape.blocks_y;
  }
  return blocks;
}

}  // namespace

struct GpuRenderer::State {
  State(Device::State& d, const StreamView& view, uint64_t cache_bytes)
      : device(d),
        stream(d, view),
        header(view.header),
        geometry(view.geometry),
        sizes(block_sizes(view.header)),
        pool(sizes, words_of_level(0), cache_bytes) {
    if (blocks_of_image(geometry) * geometry.level(0).images() >= kNoError) {
      throw MachineError(FailureKind::kLimit,
                         "limit_exceeded: frames need fewer than 2^32 - 1 blocks in all views");
    }
    pool.reserve(device, 0);
    device.kernels->prepare(KernelUse::kFrames, stream.chunked(), pool.chunked());
  }

  GpuFrame render(const FrameRecord& record, int stop_level) {
    GpuFrame frame;
    if (!fits(record, header, stop_level)) {
      frame.status = ErrorCode::kBadRequest;
      return frame;
    }
    try {
      if (submit(record, stop_level, frame) || submit(record, stop_level, frame)) return frame;
    } catch (...) {
      capacity = kFirstCapacity;  // what the next frame finds room for
      throw;
    }
    throw MachineError(FailureKind::kInternal, "the device counts other blocks for the same frame");
  }

  // Words of one bit for each block of a level.
  uint64_t words_of_level(int level) const {
    return ceil_div(geometry.level(level).images() * blocks_of_image(geometry), kBitsOfWord);
  }

  // The arguments of a submission with room for `capacity` requests.
  Arguments prepare(const FrameRecord& record, int stop_level) {
    Arguments arguments = buffers.prepare_requests(device, capacity, sizes, stream.arguments());
    shape.needed = needed.reserve(device, 4 * words_of_level(0)).address();
    shape.slots = slots.reserve(device, 4 * capacity).address();
    shape.counters = counters.reserve(device, 4 * kAllCounters).address();
    shape.dispatches = dispatches.reserve(device, 4 * kAllDispatches).address();
    shape.drawn =
        drawn.reserve(device, 12 * ceil_div(image_pixels(record), kPixelsAtOnce)).address();
    shape.stop_level = static_cast<uint32_t>(stop_level);
    shape.capacity = static_cast<uint32_t>(capacity);
    shape.needed_words = static_cast<uint32_t>(words_of_level(stop_level));
    shape.record = record;
    pool.describe(shape);
    arguments.frame = shapes.reserve(device, sizeof(FrameShape)).address();
    return arguments;
  }

  // Room for `requests` requests and `pages` pages of the pool.
  void make_room(uint64_t requests, uint64_t pages) {
    if (requests > max_requests(device, sizes, false)) {
      throw MachineError(FailureKind::kLimit,
                         "the frame needs " + std::to_string(requests) +
                             " blocks, more than the device has room for in one submission");
    }
    pool.reserve(device, pages);
    capacity = std::max(capacity, requests);
  }

  // Marks, decodes and draws; without room for that it only makes some, and returns false.
  bool submit(const FrameRecord& record, int stop_level, GpuFrame& frame) {
    pool.reserve(device, 0);
    const Arguments arguments = prepare(record, stop_level);
    Commands commands(device, &shape);
    commands.write(shapes.get(), bytes_of(std::span(&shape, 1)));
    pool.begin_frame(stop_level, commands, counters.get());
    record_kernels(record, stop_level, arguments, commands);
    const uint64_t counter_bytes = 4 * kFrameCounters;
    const uint64_t pixel_bytes = 6 * image_pixels(record);
    Buffer& readback = buffers.readback.reserve(device, counter_bytes + pixel_bytes);
    commands.copy(counters.get(), 0, readback, 0, counter_bytes);
    commands.copy(drawn.get(), 0, readback, counter_bytes, pixel_bytes);
    commands.barrier(kTransfer, kHost);
    commands.read_by_host(readback);
    times = commands.run();
    ++frame.submissions;
    const auto words = readback.records<const uint32_t>();
    if (words[kCountFirstError] == kNoError) pool.end_frame(stop_level);
    if (words[kCountMode] == kModeNoRoom) {
      make_room(words[kCountDecoded], words[kCountPages]);
      return false;
    }
    collect(record, words, frame);
    return true;
  }

  void record_kernels(const FrameRecord& record, int stop_level, const Arguments& arguments,
                      Commands& commands) const {
    const uint64_t words = words_of_level(stop_level);
    const uint64_t pixels = image_pixels(record);
    const Variant variant = variant_of(KernelUse::kFrames, stream.chunked(), pool.chunked());
    const Buffer& counts = counters.get();
    const Buffer& groups = dispatches.get();
    commands.fill(needed.get(), 0, 4 * words, 0);
    commands.fill(counts, 0, 4 * kCountFirstError, 0);
    commands.fill(counts, 4 * kCountFirstError, 4, kNoError);
    commands.fill(counts, 4 * kCountStatus, 4 * (kFrameCounters - kCountStatus), 0);
    commands.barrier(kTransfer, kCompute);
    commands.dispatch("mark", variant, arguments, pixels);
    commands.barrier(kCompute, kCompute);
    commands.dispatch("count", variant, arguments, words);
    commands.barrier(kCompute, kCompute);
    commands.dispatch("plan", variant, arguments, 1);
    commands.barrier(kCompute, kCompute | kIndirect);
    commands.dispatch("compact", variant, arguments, words);
    commands.barrier(kCompute, kCompute);
    commands.dispatch_counted("walk", variant, arguments, groups, 4 * kDispatchWalk);
    commands.barrier(kCompute, kCompute);
    commands.dispatch_counted("samples", variant, arguments, groups, 4 * kDispatchSamples);
    commands.barrier(kCompute, kCompute);
    commands.dispatch_counted("errors", variant, arguments, groups, 4 * kDispatchErrors);
    commands.barrier(kCompute, kCompute);
    commands.dispatch("render", variant, arguments, ceil_div(pixels, kPixelsAtOnce));
    commands.barrier(kCompute, kTransfer);
  }

  void collect(const FrameRecord& record, std::span<const uint32_t> words, GpuFrame& frame) const {
    frame.blocks_needed = words[kCountNeeded];
    frame.blocks_decoded = words[kCountDecoded];
    if (words[kCountFirstError] != kNoError) {
      frame.status = static_cast<ErrorCode>(words[kCountStatus]);
      return;
    }
    frame.image = {static_cast<uint32_t>(record.frame_width),
                   static_cast<uint32_t>(record.frame_height),
                   header.depth,
                   {}};
    frame.image.samples.resize(3 * static_cast<size_t>(image_pixels(record)));
    std::memcpy(frame.image.samples.data(), words.data() + kFrameCounters,
                frame.image.samples.size() * sizeof(uint16_t));
  }

  static uint64_t image_pixels(const FrameRecord& record) {
    return static_cast<uint64_t>(record.frame_width) * static_cast<uint64_t>(record.frame_height);
  }

  Device::State& device;
  DeviceStream stream;
  StreamHeader header;
  Geometry geometry;
  BlockSizes sizes;
  BlockPool pool;
  uint64_t capacity = kFirstCapacity;
  BatchBuffers buffers;
  FrameShape shape;  // of the last frame, as `shapes` has it
  GrowingBuffer shapes{Memory::kDevice};
  GrowingBuffer needed{Memory::kDevice};
  GrowingBuffer slots{Memory::kDevice};
  GrowingBuffer counters{Memory::kDevice};
  GrowingBuffer dispatches{Memory::kDevice};
  GrowingBuffer drawn{Memory::kDevice};
  std::vector<StageTime> times;
};

Outcome<GpuRenderer> GpuRenderer::open(Device& device, const StreamView& stream,
                                       uint64_t cache_bytes) {
  return guard_device(
      [&] { return GpuRenderer(std::make_shared<State>(device.state(), stream, cache_bytes)); });
}

Outcome<GpuFrame> GpuRenderer::render(const FrameRecord& record, int stop_level) {
  return guard_device([&] { return state_->render(record, stop_level); });
}

void GpuRenderer::forget() { state_->pool.forget(); }

const std::vector<StageTime>& GpuRenderer::stage_times() const { return state_->times; }

}  // namespace hmlfc::gpu
