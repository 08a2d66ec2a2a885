// One of the frames that may be under way.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "commands.hpp"
#include "frame_buffers.hpp"

namespace hmlfc::gpu {

/// Frames that may be under way at once.
inline constexpr unsigned kFramesUnderWay = 3;

class FrameSlot {
 public:
  explicit FrameSlot(Device::State& device) : device_(&device), buffers_(device) {}

  /// For a frame of `form`: makes its buffers. Whether its commands must be recorded: then they
  /// have begun.
  bool prepare(const FrameForm& form);

  FrameBuffers& buffers() { return buffers_; }
  const FrameBuffers& buffers() const { return buffers_; }
  Commands& commands() { return *commands_; }

  /// Records that the picture comes to the host, if the form says so, behind kernels that drew it,
  /// and that the host reads the results.
  void record_output();

  /// Submits commands(), which have ended, for the shape of buffers() as it is now.
  void submit();

  const FrameForm& form() const { return form_; }

  /// Waits for what was submitted, if anything was.
  void wait() {
    if (commands_) commands_->wait();
  }

  std::vector<StageTime> times() {
    if (!commands_) return {};
    commands_->read_times();
    return commands_->times();
  }

  /// Of a frame that is done, with FrameOutput::kHost: its samples, in rows of
  /// FrameForm::row_pixels pixels.
  std::span<const uint16_t> samples() const;

 private:
  Device::State* device_;
  FrameForm form_;
  std::optional<FrameForm> recorded_;
  FrameBuffers buffers_;
  GrowingBuffer readback_{Memory::kReadback};
  std::optional<Commands> commands_;  // the first to go
};

}  // namespace hmlfc::gpu
