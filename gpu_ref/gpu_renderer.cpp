#include <hmlfc/gpu/renderer.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "arithmetic/rounding.hpp"
#include "batch_buffers.hpp"
#include "block_pool.hpp"
#include "commands.hpp"
#include "decoder/open_stream.hpp"
#include "device_disparities.hpp"
#include "device_stream.hpp"
#include "frame_shape.hpp"
#include "frame_slot.hpp"
#include "render/shown_image.hpp"
#include "render/surface.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kFirstCapacity = uint64_t{1} << 14;  // blocks
constexpr uint64_t kBitsOfWord = 32;

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
        source(view),
        header(view.header),
        geometry(view.geometry),
        sizes(block_sizes(view.header)),
        pool(sizes, words_of_level(0), cache_bytes),
        slots{FrameSlot(d), FrameSlot(d), FrameSlot(d)} {
    if (blocks_of_image(geometry) * geometry.level(0).images() >= kNoError) {
      throw MachineError(FailureKind::kLimit,
                         "limit_exceeded: frames need fewer than 2^32 - 1 blocks in all views");
    }
    source.reads = nullptr;
    make_bits(needed);
    make_room(kFirstCapacity, 0);
    device.kernels->prepare(KernelUse::kFrames, stream.chunked(), pool.chunked());
  }

  GpuFrame render(const FrameRecord& record, int stop_level) {
    GpuFrame frame;
    begin(record, stop_level, FrameOutput::kHost);
    finish(frame);
    return frame;
  }

  void begin(const FrameRecord& record, int stop_level, FrameOutput output) {
    if (under_way == kFramesUnderWay) {
      throw MachineError(FailureKind::kLimit, std::to_string(kFramesUnderWay) +
                                                  " frames are under way: finish one first");
    }
    const unsigned number = (first + under_way) % kFramesUnderWay;
    refused[number] = !fits(record, header, stop_level);
    if (!refused[number]) {
      const bool geometric = has_geometry(record, stop_level);
      if (geometric && !disparities) prepare_geometry();
      FrameSlot& slot = slots[number];
      slot.shape().record = record;
      submit(slot, {record.frame_width, record.frame_height, static_cast<uint32_t>(stop_level),
                    geometric, output, room});
    }
    ++under_way;
  }

  bool ready() { return under_way == 0 || refused[first] || slots[first].commands().done(); }

  void finish(GpuFrame& frame) {
    if (under_way == 0) throw MachineError(FailureKind::kLimit, "no frame is under way");
    last = first;
    first = (first + 1) % kFramesUnderWay;
    --under_way;
    frame.status = ErrorCode::kBadRequest;
    frame.image.samples.clear();
    frame.blocks_needed = frame.blocks_decoded = frame.disparities_looked_up = 0;
    frame.submissions = 0;
    if (refused[last]) return;
    try {
      finish(slots[last], frame);
    } catch (...) {
      pool.forget();
      throw;
    }
  }

  // A bit for each block, all 0.
  void make_bits(GrowingBuffer& bits) {
    const Buffer& buffer = bits.reserve(device, 4 * words_of_level(0));
    Commands commands(device);
    commands.fill(buffer, 0, buffer.size(), 0);
    commands.run();
  }

  // What the first frame with geometry waits for.
  void prepare_geometry() {
    device.kernels->prepare(KernelUse::kGeometry, stream.chunked(), pool.chunked());
    make_bits(looked_up);
    disparities.emplace(upload_disparities(device, source));
  }

  // Words of one bit for each block of a level.
  uint64_t words_of_level(int level) const {
    return ceil_div(geometry.level(level).images() * blocks_of_image(geometry), kBitsOfWord);
  }

  // Makes room for `requests` requests and `pages` pages of the pool. No frame may be under way on
  // the device.
  void make_room(uint64_t requests, uint64_t pages) {
    const uint64_t most = max_requests(device, sizes, false);
    if (requests > most) {
      throw MachineError(FailureKind::kLimit,
                         "the frame needs " + std::to_string(requests) +
                             " blocks, more than the device has room for in one submission");
    }
    ++room;
    pool.reserve(device, pages);
    // More than is needed now: a camera that needs ever more must not come back each frame.
    if (requests > capacity) capacity = std::max(requests, std::min(2 * capacity, most));
    arguments = buffers.prepare_requests(device, capacity, sizes, stream.arguments());
    slot_numbers.reserve(device, 8 * capacity);
    dispatches.reserve(device, 4 * kAllDispatches);
  }

  // Submits a frame whose record is in `slot`.
  void submit(FrameSlot& slot, const FrameForm& form) {
    if (slot.prepare(form)) record(slot, form);
    slot.shape().forget = pool.begin_frame(static_cast<int>(form.stop_level)) ? 1 : 0;
    slot.submit();
  }

  void describe(FrameShape& shape, uint32_t stop_level) const {
    shape.needed = needed.get().address();
    if (disparities) {
      shape.looked_up = looked_up.get().address();
      shape.disparities = disparities->address();
    }
    shape.slots = slot_numbers.get().address();
    shape.dispatches = dispatches.get().address();
    shape.stop_level = stop_level;
    shape.capacity = static_cast<uint32_t>(capacity);
    shape.needed_words = static_cast<uint32_t>(words_of_level(static_cast<int>(stop_level)));
    pool.describe(shape);
  }

  // The commands of a frame in `slot`.
  void record(FrameSlot& slot, const FrameForm& form) {
    describe(slot.shape(), form.stop_level);
    arguments.frame = slot.shape_buffer().address();
    const Variant variant = variant_of(KernelUse::kFrames, stream.chunked(), pool.chunked());
    // Of the kernels that know of pixels.
    const Variant drawing = variant_of(form.geometry ? KernelUse::kGeometry : KernelUse::kFrames,
                                       stream.chunked(), pool.chunked());
    const Buffer& groups = dispatches.get();
    Commands& commands = slot.commands();
    slot.record_upload();
    // Frames before this one may still be under way.
    commands.barrier(kCompute | kTransfer | kIndirect, kCompute);
    if (form.geometry) {
      commands.dispatch("surface", drawing, arguments, form.cells());
      commands.barrier(kCompute, kCompute);
    }
    commands.dispatch_groups("mark", drawing, arguments, form.columns(), form.rows());
    commands.barrier(kCompute, kCompute | kIndirect);
    commands.dispatch("compact", drawing, arguments, slot.shape().needed_words);
    commands.barrier(kCompute, kCompute);
    commands.dispatch_counted("walk", variant, arguments, groups, 4 * kDispatchWalk);
    commands.barrier(kCompute, kCompute);
    commands.dispatch_counted("samples", variant, arguments, groups, 4 * kDispatchSamples);
    commands.barrier(kCompute, kCompute);
    commands.dispatch_groups("render", drawing, arguments, form.columns(), form.rows());
    slot.record_output();
    commands.end();
  }

  // Waits for the frame in `slot`; where it had no room, makes some and submits it once more.
  void finish(FrameSlot& slot, GpuFrame& frame) {
    slot.commands().wait();
    frame.submissions = 1;
    if (slot.counters()[kCountMode] == kModeNoRoom) {
      for (FrameSlot& other : slots) other.wait();
      make_room(slot.counters()[kCountDecoded], slot.counters()[kCountPages]);
      FrameForm form = slot.form();
      form.room = room;
      submit(slot, form);
      slot.commands().wait();
      frame.submissions = 2;
    }
    if (slot.counters()[kCountMode] == kModeNoRoom) {
      throw MachineError(FailureKind::kInternal,
                         "the device counts other blocks for the same frame");
    }
    collect(slot, frame);
  }

  const std::vector<StageTime>& stage_times() {
    times = slots[last].times();
    return times;
  }

  void collect(const FrameSlot& slot, GpuFrame& frame) const {
    const auto words = slot.counters();
    frame.blocks_needed = words[kCountNeeded];
    frame.blocks_decoded = words[kCountDecoded];
    frame.disparities_looked_up = words[kCountLookedUp];
    frame.status = ErrorCode::kOk;
    if (words[kCountFirstError] != kNoError) {
      frame.status = static_cast<ErrorCode>(words[kCountStatus]);
      return;
    }
    frame.image.width = static_cast<uint32_t>(slot.form().width);
    frame.image.height = static_cast<uint32_t>(slot.form().height);
    frame.image.depth = header.depth;
    if (slot.form().output == FrameOutput::kDevice) return;
    const size_t row = size_t{3} * frame.image.width;
    frame.image.samples.resize(row * frame.image.height);
    const uint16_t* from = slot.samples().data();
    for (uint32_t y = 0; y < frame.image.height; ++y) {
      std::copy_n(from, row, frame.image.samples.begin() + static_cast<ptrdiff_t>(y * row));
      from += 3 * static_cast<size_t>(slot.form().row_pixels());
    }
  }

  Device::State& device;
  DeviceStream stream;
  StreamView source;
  StreamHeader header;
  Geometry geometry;
  BlockSizes sizes;
  BlockPool pool;
  uint64_t capacity = 0;
  uint64_t room = 0;  // counts make_room()
  BatchBuffers buffers;
  Arguments arguments;
  GrowingBuffer needed{Memory::kDevice};
  GrowingBuffer looked_up{Memory::kDevice};
  std::optional<Buffer> disparities;  // once a frame has geometry
  GrowingBuffer slot_numbers{Memory::kDevice};
  GrowingBuffer dispatches{Memory::kDevice};

  // Frames under way: `under_way` from slot `first` on.
  std::array<FrameSlot, kFramesUnderWay> slots;
  std::array<bool, kFramesUnderWay> refused{};  // nothing was submitted: they do not fit
  unsigned first = 0;
  unsigned under_way = 0;
  unsigned last = 0;  // slot of the last frame finished
  std::vector<StageTime> times;
};

Outcome<GpuRenderer> GpuRenderer::open(Device& device, const StreamView& stream,
                                       uint64_t cache_bytes) {
  return guard_device(
      [&] { return GpuRenderer(std::make_shared<State>(device.state(), stream, cache_bytes)); });
}

Outcome<GpuRenderer> GpuRenderer::open(Device& device, const Decoder& stream,
                                       uint64_t cache_bytes) {
  return open(device, DecoderAccess::stream(stream), cache_bytes);
}

Outcome<GpuFrame> GpuRenderer::render(const FrameRecord& record, int stop_level) {
  return guard_device([&] { return state_->render(record, stop_level); });
}

Outcome<void> GpuRenderer::begin(const FrameRecord& record, int stop_level, FrameOutput output) {
  return guard_device([&] { state_->begin(record, stop_level, output); });
}

unsigned GpuRenderer::most_under_way() { return kFramesUnderWay; }

unsigned GpuRenderer::under_way() const { return state_->under_way; }

Outcome<bool> GpuRenderer::ready() {
  return guard_device([&] { return state_->ready(); });
}

Outcome<void> GpuRenderer::finish(GpuFrame& frame) {
  return guard_device([&] { state_->finish(frame); });
}

uint64_t GpuRenderer::picture_address() const {
  return state_->slots[state_->last].drawn().address();
}

void GpuRenderer::forget() { state_->pool.forget(); }

const std::vector<StageTime>& GpuRenderer::stage_times() const { return state_->stage_times(); }

}  // namespace hmlfc::gpu
