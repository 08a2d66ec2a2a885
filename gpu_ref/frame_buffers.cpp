#include "frame_buffers.hpp"

#include <cstring>

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kCounterBytes = uint64_t{4} * kFrameCounters;
constexpr uint64_t kRayBytes = 16;          // of a pixel of a group
constexpr uint64_t kDisplacementBytes = 4;  // of a cell

}  // namespace

FrameBuffers::FrameBuffers(Device::State& device)
    : upload_(device, sizeof(FrameShape) + kCounterBytes, Memory::kUpload),
      shape_buffer_(device, sizeof(FrameShape), Memory::kDevice),
      counters_(device, kCounterBytes, Memory::kDevice),
      results_(device, kCounterBytes, Memory::kReadback) {
  auto counters = upload_.records<uint32_t>().subspan(sizeof(FrameShape) / 4);
  std::memset(counters.data(), 0, counters.size_bytes());
  counters[kCountFirstError] = kNoError;
}

void FrameBuffers::prepare(Device::State& device, const FrameForm& form) {
  shape_.counters = counters_.address();
  shape_.results = results_.address();
  shape_.drawn = drawn_.reserve(device, form.drawn_bytes()).address();
  const uint64_t groups = uint64_t{form.columns()} * form.rows();
  shape_.rays = rays_.reserve(device, kRayBytes * groups * kGroupPixels * kGroupPixels).address();
  if (form.geometry) {
    shape_.displacements =
        displacements_.reserve(device, kDisplacementBytes * form.cells()).address();
  }
}

void FrameBuffers::write_shape() { std::memcpy(upload_.bytes().data(), &shape_, sizeof(shape_)); }

void FrameBuffers::record_upload(Recorder& commands) const {
  commands.copy(upload_, 0, shape_buffer_, 0, sizeof(FrameShape));
  commands.copy(upload_, sizeof(FrameShape), counters_, 0, kCounterBytes);
}

}  // namespace hmlfc::gpu
