#include "stream_renderer.hpp"

#include <algorithm>
#include <string>

#include "arithmetic/rounding.hpp"
#include "commands.hpp"
#include "device_disparities.hpp"

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

StreamRenderer::StreamRenderer(Device::State& d, const StreamView& view, uint64_t cache_bytes)
    : device(d),
      stream(d, view),
      source(view),
      header(view.header),
      geometry(view.geometry),
      sizes(block_sizes(view.header)),
      pool(sizes, words_of_level(0), cache_bytes) {
  if (blocks_of_image(geometry) * geometry.level(0).images() >= kNoError) {
    throw MachineError(FailureKind::kLimit,
                       "limit_exceeded: frames need fewer than 2^32 - 1 blocks in all views");
  }
  source.reads = nullptr;
  make_bits(needed_);
  make_room(kFirstCapacity, 0);
  device.kernels->prepare(KernelUse::kFrames, stream.chunked(), pool.chunked());
}

FrameForm StreamRenderer::form_of(const FrameRecord& record, int stop_level) {
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
void StreamRenderer::make_bits(GrowingBuffer& bits) {
  const Buffer& buffer = bits.reserve(device, 4 * words_of_level(0));
  Commands commands(device);
  commands.fill(buffer, 0, buffer.size(), 0);
  commands.run();
}

// What the first frame with geometry waits for.
void StreamRenderer::prepare_geometry() {
  device.kernels->prepare(KernelUse::kGeometry, stream.chunked(), pool.chunked());
  make_bits(looked_up_);
  disparities_.emplace(upload_disparities(device, source));
}

// Words of one bit for each block of a level.
uint64_t StreamRenderer::words_of_level(int level) const {
  return ceil_div(geometry.level(level).images() * blocks_of_image(geometry), kBitsOfWord);
}

void StreamRenderer::make_room(uint64_t requests, uint64_t pages) {
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

void StreamRenderer::describe(FrameShape& shape, uint32_t stop_level) const {
  shape.needed = needed_.get().address();
  if (disparities_) {
    shape.looked_up = looked_up_.get().address();
    shape.disparities = disparities_->address();
  }
  shape.slots = slot_numbers_.get().address();
  shape.dispatches = dispatches_.get().address();
  shape.stop_level = stop_level;
  shape.capacity = static_cast<uint32_t>(capacity_);
  shape.needed_words = static_cast<uint32_t>(words_of_level(static_cast<int>(stop_level)));
  pool.describe(shape);
}

void StreamRenderer::record(Recorder& commands, FrameBuffers& frame, const FrameForm& form) {
  describe(frame.shape(), form.stop_level);
  arguments_.frame = frame.shape_buffer().address();
  const Variant decoding = variant_of(KernelUse::kFrames, stream.chunked(), pool.chunked());
  // Of the kernels that know of pixels.
  Variant drawing = decoding;
  drawing.geometry = form.geometry;
  Variant picture = drawing;
  picture.texels = form.texel_bytes != 0;
  const Buffer& groups = dispatches_.get();
  frame.record_upload(commands);
  // Frames before this one may still be under way.
  commands.barrier(kCompute | kTransfer | kIndirect, kCompute);
  if (form.geometry) {
    commands.dispatch("surface", drawing, arguments_, form.cells());
    commands.barrier(kCompute, kCompute);
  }
  commands.dispatch_groups("mark", drawing, arguments_, form.columns(), form.rows());
  commands.barrier(kCompute, kCompute | kIndirect);
  commands.dispatch("compact", drawing, arguments_, frame.shape().needed_words);
  commands.barrier(kCompute, kCompute);
  commands.dispatch_counted("walk", decoding, arguments_, groups, 4 * kDispatchWalk);
  commands.barrier(kCompute, kCompute);
  commands.dispatch_counted("samples", decoding, arguments_, groups, 4 * kDispatchSamples);
  commands.barrier(kCompute, kCompute);
  commands.dispatch_groups("render", picture, arguments_, form.columns(), form.rows());
}

}  // namespace hmlfc::gpu
