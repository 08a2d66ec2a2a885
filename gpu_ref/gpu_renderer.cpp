#include "gpu_renderer.hpp"

#include <algorithm>
#include <cstring>

#include "batch_buffers.hpp"
#include "commands.hpp"
#include "device_stream.hpp"
#include "frame_shape.hpp"
#include "render/shown_image.hpp"
#include "values/rounding.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kFirstCapacity = uint64_t{1} << 14;  // blocks
constexpr uint32_t kNoError = ~0u;

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
  State(Device::State& d, const StreamView& view)
      : device(d),
        stream(d, view),
        header(view.header),
        geometry(view.geometry),
        sizes(block_sizes(view.header)) {
    if (blocks_of_image(geometry) * geometry.level(0).images() >= kNoError) {
      throw MachineError("limit_exceeded: frames need fewer than 2^32 - 1 blocks in all views");
    }
  }

  GpuFrame render(const FrameRecord& record, int stop_level) {
    GpuFrame frame;
    if (!fits(record, header, stop_level)) {
      frame.status = ErrorCode::kBadRequest;
      return frame;
    }
    submit(record, stop_level, frame);
    if (frame.blocks_needed > capacity) {
      capacity = frame.blocks_needed;
      submit(record, stop_level, frame);
    }
    return frame;
  }

  // The arguments of a submission with room for `capacity` requests.
  Arguments prepare(const FrameRecord& record, int stop_level, uint64_t needed_words) {
    if (capacity > most_requests(device, sizes, false)) {
      throw MachineError("the frame needs " + std::to_string(capacity) +
                         " blocks, more than the device has room for in one submission");
    }
    Batch batch;
    batch.requests = capacity;
    batch.areas.emplace_back();
    Arguments arguments = buffers.prepare(device, batch, sizes, false, stream.arguments());
    const uint64_t pixels = uint64_t{image_pixels(record)};
    Buffer& shape = shapes.reserve(device, sizeof(FrameShape));
    shape.records<FrameShape>()[0] = {
        needed.reserve(device, 4 * needed_words).address(),
        first_slots.reserve(device, 4 * needed_words).address(),
        counters.reserve(device, 4 * kFrameCounters).address(),
        drawn.reserve(device, 12 * ceil_div(pixels, uint64_t{2})).address(),
        static_cast<uint32_t>(stop_level),
        static_cast<uint32_t>(capacity),
        static_cast<uint32_t>(needed_words),
        record};
    arguments.frame = shape.address();
    return arguments;
  }

  // Marks, decodes and draws; without room it only counts the blocks.
  void submit(const FrameRecord& record, int stop_level, GpuFrame& frame) {
    const uint64_t images = geometry.level(stop_level).images();
    const uint64_t needed_words = ceil_div(images * blocks_of_image(geometry), uint64_t{32});
    const Arguments arguments = prepare(record, stop_level, needed_words);
    const uint64_t pixels = image_pixels(record);
    const Variant variant{.chunked = stream.chunked(), .counted = true};
    Commands commands(device);
    commands.fill(needed.get(), 0, 4 * needed_words, 0);
    commands.fill(counters.get(), 0, 4 * kFrameCounters, 0);
    commands.fill(counters.get(), 4 * kCountFirstError, 4, kNoError);
    commands.dispatch("mark", Kernel::kMark, variant, arguments, pixels);
    commands.dispatch("compact", Kernel::kCompact, variant, arguments, needed_words);
    commands.dispatch("plan", Kernel::kPlan, variant, arguments, 1);
    commands.dispatch_counted("walk", Kernel::kWalk, variant, arguments, counters.get(),
                              4 * kCountWalk);
    commands.dispatch_counted("samples", Kernel::kSamples, variant, arguments, counters.get(),
                              4 * kCountSamples);
    commands.dispatch_counted("errors", Kernel::kErrors, variant, arguments, counters.get(),
                              4 * kCountErrors);
    commands.dispatch("render", Kernel::kRender, variant, arguments, ceil_div(pixels, uint64_t{2}));
    const uint64_t counter_bytes = 4 * kFrameCounters;
    Buffer& readback = buffers.readback.reserve(device, counter_bytes + 6 * pixels);
    commands.copy(counters.get(), 0, readback, 0, counter_bytes);
    commands.copy(drawn.get(), 0, readback, counter_bytes, 6 * pixels);
    times = commands.run();
    ++frame.submissions;
    collect(record, readback, frame);
  }

  void collect(const FrameRecord& record, const Buffer& readback, GpuFrame& frame) const {
    const auto words = readback.records<const uint32_t>();
    frame.blocks_needed = words[kCountNeeded];
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
  uint64_t capacity = kFirstCapacity;
  BatchBuffers buffers;
  GrowingBuffer shapes{Memory::kUpload};
  GrowingBuffer needed{Memory::kDevice};
  GrowingBuffer first_slots{Memory::kDevice};
  GrowingBuffer counters{Memory::kDevice};
  GrowingBuffer drawn{Memory::kDevice};
  std::vector<StageTime> times;
};

GpuRenderer::GpuRenderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
GpuRenderer::GpuRenderer(GpuRenderer&&) noexcept = default;
GpuRenderer& GpuRenderer::operator=(GpuRenderer&&) noexcept = default;
GpuRenderer::~GpuRenderer() = default;

Outcome<GpuRenderer> GpuRenderer::open(Device& device, const StreamView& stream) {
  return guard_device([&] { return GpuRenderer(std::make_unique<State>(device.state(), stream)); });
}

Outcome<GpuFrame> GpuRenderer::render(const FrameRecord& record, int stop_level) {
  return guard_device([&] { return state_->render(record, stop_level); });
}

const std::vector<StageTime>& GpuRenderer::stage_times() const { return state_->times; }

}  // namespace hmlfc::gpu
