#include "frame_buffers.hpp"

#include <cstring>

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kCounterBytes = uint64_t{4} * kFrameCounters;
constexpr uint64_t kRayBytes = 16;          // of a pixel of a group
constexpr uint64_t kDisplacementBytes = 4;  // of a cell

}  // namespace

FrameBuffers::FrameBuffers(Device::State& device)
    : upload_(device, sizeof(FrameArguments) + kCounterBytes, Memory::kUpload),
      arguments_buffer_(device, sizeof(FrameArguments), Memory::kDevice),
      counters_(device, kCounterBytes, Memory::kDevice),
      results_(device, kCounterBytes, Memory::kReadback) {
  auto counters = upload_.records<uint32_t>().subspan(sizeof(FrameArguments) / 4);
  std::memset(counters.data(), 0, counters.size_bytes());
  counters[kCountFirstError] = kNoError;
}

void FrameBuffers::prepare(Device::State& device, const FrameForm& form) {
  arguments_.counters = counters_.address();
  arguments_.results = results_.address();
  arguments_.drawn = drawn_.reserve(device, form.drawn_bytes()).address();
  const uint64_t groups = uint64_t{form.columns()} * form.rows();
  arguments_.rays =
      rays_.reserve(device, kRayBytes * groups * kGroupPixels * kGroupPixels).address();
  if (form.geometry) {
    arguments_.displacements =
        displacements_.reserve(device, kDisplacementBytes * form.cells()).address();
  }
}

void FrameBuffers::write_arguments() {
  std::memcpy(upload_.bytes().data(), &arguments_, sizeof(arguments_));
}

ErrorCode FrameBuffers::status() const {
  const auto words = counters();
  return words[kCountFirstError] == kNoError ? ErrorCode::kOk
                                             : static_cast<ErrorCode>(words[kCountStatus]);
}

void FrameBuffers::write_upload(Commands& commands) const {
  commands.copy(upload_, 0, arguments_buffer_, 0, sizeof(FrameArguments));
  commands.copy(upload_, sizeof(FrameArguments), counters_, 0, kCounterBytes);
}

}  // namespace hmlfc::gpu
