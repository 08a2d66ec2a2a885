#include "renderer_state.hpp"

#include <algorithm>
#include <string>

#include "arithmetic/rounding.hpp"
#include "device/submission.hpp"
#include "disparities.hpp"

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

GpuRenderer::State::State(Device::State& d, const StreamView& view, uint64_t cache_bytes)
    : device(d),
      stream(d, view),
      source(view),
      header(view.header),
      geometry(view.geometry),
      sizes(block_sizes(view.header)),
      pool(sizes, words_of_level(0), cache_bytes),
      ring(*this) {
  if (blocks_of_image(geometry) * geometry.level(0).images() >= kNoError) {
    throw MachineError(FailureKind::kLimit,
                       "limit_exceeded: frames need fewer than 2^32 - 1 blocks in all views");
  }
  source.reads = nullptr;
  make_bits(needed_);
  make_room(kFirstCapacity, 0);
  device.kernels->prepare(KernelUse::kFrames, stream.chunked(), pool.chunked());
}

FrameForm GpuRenderer::State::form_of(const FrameRecord& record, int stop_level) {
  if (!has_room_) make_room(0, 0);
  FrameForm form;
  form.width = record.frame_width;
  form.height = record.frame_height;
  form.stop_level = static_cast<uint32_t>(stop_level);
  form.geometry = has_geometry(record, stop_level);
  form.room = room_;
  if (form.geometry && !disparities_) prepare_geometry();
  return form;
}

// A bit for each block, all 0.
void GpuRenderer::State::make_bits(GrowingBuffer& bits) {
  const Buffer& buffer = bits.reserve(device, 4 * words_of_level(0));
  Submission commands(device);
  commands.fill(buffer, 0, buffer.size(), 0);
  commands.run();
}

// What the first frame with geometry waits for.
void GpuRenderer::State::prepare_geometry() {
  device.kernels->prepare(KernelUse::kGeometry, stream.chunked(), pool.chunked());
  make_bits(looked_up_);
  disparities_.emplace(upload_disparities(device, source));
}

// Words of one bit for each block of a level.
uint64_t GpuRenderer::State::words_of_level(int level) const {
  return ceil_div(geometry.level(level).images() * blocks_of_image(geometry), kBitsOfWord);
}

void GpuRenderer::State::make_room(uint64_t requests, uint64_t pages) {
  const uint64_t most = max_requests(device, sizes, false);
  if (requests > most) {
    throw MachineError(FailureKind::kLimit,
                       "the frame needs " + std::to_string(requests) +
                           " blocks, more than the device has room for in one submission");
  }
  ++room_;
  has_room_ = false;
  pool.reserve(device, pages);
  // More than is needed now: a camera that needs ever more must not come back each frame.
  const uint64_t wanted =
      requests > capacity_ ? std::max(requests, std::min(2 * capacity_, most)) : capacity_;
  arguments_ = buffers_.prepare_requests(device, wanted, sizes, stream.arguments());
  slot_numbers_.reserve(device, 8 * wanted);
  dispatches_.reserve(device, 4 * kAllDispatches);
  capacity_ = wanted;
  has_room_ = true;
}

void GpuRenderer::State::describe(FrameArguments& frame, uint32_t stop_level) const {
  frame.needed = needed_.get().address();
  if (disparities_) {
    frame.looked_up = looked_up_.get().address();
    frame.disparities = disparities_->address();
  }
  frame.slots = slot_numbers_.get().address();
  frame.dispatches = dispatches_.get().address();
  frame.stop_level = stop_level;
  frame.capacity = static_cast<uint32_t>(capacity_);
  frame.needed_words = static_cast<uint32_t>(words_of_level(static_cast<int>(stop_level)));
  pool.describe(frame);
}

void GpuRenderer::State::write(Commands& commands, FrameBuffers& frame, const FrameForm& form) {
  describe(frame.arguments(), form.stop_level);
  arguments_.frame = frame.arguments_buffer().address();
  const Variant decoding = variant_of(KernelUse::kFrames, stream.chunked(), pool.chunked());
  Variant drawing = decoding;
  drawing.geometry = form.geometry;
  Variant picture = drawing;
  picture.texels = form.texel_bytes != 0;
  const Buffer& groups = dispatches_.get();
  frame.write_upload(commands);
  // Frames before this one may still be under way.
  commands.barrier(kCompute | kTransfer | kIndirect, kCompute);
  if (form.geometry) {
    commands.dispatch("surface", drawing, arguments_, form.cells());
    commands.barrier(kCompute, kCompute);
  }
  commands.dispatch_groups("mark", drawing, arguments_, form.columns(), form.rows());
  commands.barrier(kCompute, kCompute | kIndirect);
  commands.dispatch("compact", drawing, arguments_, frame.arguments().needed_words);
  commands.barrier(kCompute, kCompute);
  commands.dispatch_counted("walk", decoding, arguments_, groups, 4 * kDispatchWalk);
  commands.barrier(kCompute, kCompute);
  commands.dispatch_counted("samples", decoding, arguments_, groups, 4 * kDispatchSamples);
  commands.barrier(kCompute, kCompute);
  commands.dispatch_groups("render", picture, arguments_, form.columns(), form.rows());
}

}  // namespace hmlfc::gpu
