#include "frame_slot.hpp"

#include <cstring>

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kCounterBytes = uint64_t{4} * kFrameCounters;
constexpr uint64_t kRayBytes = 16;          // of a pixel of a group
constexpr uint64_t kDisplacementBytes = 4;  // of a cell
constexpr uint64_t kPixelBytes = 6;

}  // namespace

FrameSlot::FrameSlot(Device::State& device)
    : device_(&device),
      upload_(device, sizeof(FrameShape) + kCounterBytes, Memory::kUpload),
      shape_buffer_(device, sizeof(FrameShape), Memory::kDevice),
      counters_(device, kCounterBytes, Memory::kDevice),
      results_(device, kCounterBytes, Memory::kReadback) {
  auto counters = upload_.records<uint32_t>().subspan(sizeof(FrameShape) / 4);
  std::memset(counters.data(), 0, counters.size_bytes());
  counters[kCountFirstError] = kNoError;
}

bool FrameSlot::prepare(const FrameForm& form) {
  form_ = form;
  // The check of barriers follows every submission.
  if (recorded_ == form && !device_->hazards) return false;
  recorded_.reset();
  shape_.counters = counters_.address();
  shape_.results = results_.address();
  const uint64_t drawn_bytes = kPixelBytes * form.drawn_pixels();
  shape_.drawn = drawn_.reserve(*device_, drawn_bytes).address();
  const uint64_t groups = uint64_t{form.columns()} * form.rows();
  shape_.rays = rays_.reserve(*device_, kRayBytes * groups * kGroupPixels * kGroupPixels).address();
  if (form.geometry) {
    shape_.displacements =
        displacements_.reserve(*device_, kDisplacementBytes * form.cells()).address();
  }
  if (form.output == FrameOutput::kHost) readback_.reserve(*device_, drawn_bytes);
  if (commands_) {
    commands_->restart();
  } else {
    commands_.emplace(*device_, &shape_);
  }
  return true;
}

void FrameSlot::record_upload() {
  commands_->copy(upload_, 0, shape_buffer_, 0, sizeof(FrameShape));
  commands_->copy(upload_, sizeof(FrameShape), counters_, 0, kCounterBytes);
}

void FrameSlot::record_output() {
  if (form_.output == FrameOutput::kHost) {
    commands_->barrier(kCompute, kTransfer);
    commands_->copy(drawn_.get(), 0, readback_.get(), 0, kPixelBytes * form_.drawn_pixels());
    commands_->barrier(kCompute | kTransfer, kHost);
    commands_->read_by_host(readback_.get());
  } else {
    commands_->barrier(kCompute, kHost);
  }
  commands_->read_by_host(results_);
}

void FrameSlot::submit() {
  recorded_ = form_;
  std::memcpy(upload_.bytes().data(), &shape_, sizeof(shape_));
  commands_->submit();
}

std::span<const uint16_t> FrameSlot::samples() const {
  return readback_.get().records<const uint16_t>().first(3 *
                                                         static_cast<size_t>(form_.drawn_pixels()));
}

}  // namespace hmlfc::gpu
