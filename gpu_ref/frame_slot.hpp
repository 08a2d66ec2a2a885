// One of the frames that may be under way: what it has for itself on the device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/gpu/renderer.hpp>

#include "arithmetic/rounding.hpp"
#include "batch_buffers.hpp"
#include "commands.hpp"
#include "frame_shape.hpp"
#include "render/surface.hpp"

namespace hmlfc::gpu {

/// Frames that may be under way at once.
inline constexpr unsigned kFramesUnderWay = 3;

/// What the commands of a frame depend on: they are recorded anew where it changes.
struct FrameForm {
  int32_t width = 0;
  int32_t height = 0;
  uint32_t stop_level = 0;
  bool geometry = false;
  FrameOutput output = FrameOutput::kHost;
  uint64_t room = 0;  ///< counts how often the buffers that frames share were made anew

  friend bool operator==(const FrameForm&, const FrameForm&) = default;

  /// Groups of pixels of mark.comp and render.comp.
  uint32_t columns() const { return ceil_div(static_cast<uint32_t>(width), kGroupPixels); }
  uint32_t rows() const { return ceil_div(static_cast<uint32_t>(height), kGroupPixels); }

  /// Cells of surface.comp.
  uint64_t cells() const {
    return uint64_t{static_cast<uint32_t>(cells_along(width))} *
           static_cast<uint32_t>(cells_along(height));
  }

  /// The picture as render.comp writes it: rows of an even number of pixels.
  uint64_t row_pixels() const { return 2 * ceil_div(static_cast<uint64_t>(width), uint64_t{2}); }
  uint64_t drawn_pixels() const { return row_pixels() * static_cast<uint64_t>(height); }
};

class FrameSlot {
 public:
  explicit FrameSlot(Device::State& device);

  /// For a frame of `form`: makes the buffers of its picture. Whether its commands must be
  /// recorded: then they have begun, and the part of shape() that is the slot's own is written.
  bool prepare(const FrameForm& form);

  /// What the kernels know of the frame; the upload brings it to the device.
  FrameShape& shape() { return shape_; }
  const Buffer& shape_buffer() const { return shape_buffer_; }
  Commands& commands() { return *commands_; }

  /// Records that shape() and counters at their first values come to the device.
  void record_upload();

  /// Records that the picture comes to the host, if the form says so, behind kernels that drew it,
  /// and that the host reads the results.
  void record_output();

  /// Submits commands(), which have ended, for shape() as it is now.
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

  /// Of a frame that is done: its counters and, with FrameOutput::kHost, its samples, in rows of
  /// FrameForm::row_pixels pixels.
  std::span<const uint32_t> counters() const { return results_.records<const uint32_t>(); }
  std::span<const uint16_t> samples() const;

  /// The device's buffer of the picture.
  const Buffer& drawn() const { return drawn_.get(); }

 private:
  Device::State* device_;
  FrameForm form_;
  std::optional<FrameForm> recorded_;
  FrameShape shape_;
  Buffer upload_;  // as shape_buffer_, then counters_
  Buffer shape_buffer_;
  Buffer counters_;
  Buffer results_;
  GrowingBuffer drawn_{Memory::kDevice};
  GrowingBuffer rays_{Memory::kDevice};
  GrowingBuffer displacements_{Memory::kDevice};
  GrowingBuffer readback_{Memory::kReadback};
  std::optional<Commands> commands_;  // the first to go
};

}  // namespace hmlfc::gpu
