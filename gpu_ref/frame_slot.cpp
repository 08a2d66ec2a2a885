#include "frame_slot.hpp"

namespace hmlfc::gpu {

bool FrameSlot::prepare(const FrameForm& form) {
  form_ = form;
  // The check of barriers follows every submission.
  if (recorded_ == form && !device_->hazards) return false;
  recorded_.reset();
  buffers_.prepare(*device_, form);
  if (form.output == FrameOutput::kHost) readback_.reserve(*device_, form.drawn_bytes());
  if (commands_) {
    commands_->restart();
  } else {
    commands_.emplace(*device_, &buffers_.shape());
  }
  return true;
}

void FrameSlot::record_output() {
  if (form_.output == FrameOutput::kHost) {
    commands_->barrier(kCompute, kTransfer);
    commands_->copy(buffers_.drawn(), 0, readback_.get(), 0, form_.drawn_bytes());
    commands_->barrier(kCompute | kTransfer, kHost);
    commands_->read_by_host(readback_.get());
  } else {
    commands_->barrier(kCompute, kHost);
  }
  commands_->read_by_host(buffers_.results());
}

void FrameSlot::submit() {
  recorded_ = form_;
  buffers_.write_shape();
  commands_->submit();
}

std::span<const uint16_t> FrameSlot::samples() const {
  const auto bytes = static_cast<size_t>(form_.drawn_bytes());
  return readback_.get().records<const uint16_t>().first(bytes / sizeof(uint16_t));
}

}  // namespace hmlfc::gpu
