// The frames of a renderer that are under way.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <hmlfc/gpu/renderer.hpp>

#include "device/submission.hpp"
#include "frame_buffers.hpp"

namespace hmlfc::gpu {

/// Up to kSlots frames, which begin and finish in the same order. The functions are those of
/// GpuRenderer, and throw MachineError.
class FrameRing {
 public:
  static constexpr unsigned kSlots = 3;

  /// `renderer` outlives this.
  explicit FrameRing(GpuRenderer::State& renderer);

  void begin(const FrameRecord& record, int stop_level, FrameOutput output);
  bool ready();
  void finish(GpuFrame& frame);
  unsigned under_way() const { return under_way_; }
  uint64_t picture_address() const { return slots_[last_].buffers.drawn().address(); }

  /// The times of the frame finished last, until the next call.
  const std::vector<StageTime>& stage_times();

 private:
  struct Slot {
    explicit Slot(Device::State& device) : buffers(device) {}

    FrameBuffers buffers;
    GrowingBuffer readback{Memory::kReadback};
    FrameForm form;                      ///< of the frame
    std::optional<FrameForm> recorded;   ///< of the commands
    bool refused = false;                ///< nothing was submitted: the frame does not fit
    std::optional<Submission> commands;  ///< the first to be destroyed
  };

  void submit(Slot& slot, const FrameForm& form);
  void write_output(Slot& slot);
  void finish(Slot& slot, GpuFrame& frame);
  void submit_with_room(Slot& slot);
  void collect(const Slot& slot, GpuFrame& frame) const;

  GpuRenderer::State& renderer_;
  std::array<Slot, kSlots> slots_;
  unsigned first_ = 0;  // of the frames under way
  unsigned under_way_ = 0;
  unsigned last_ = 0;  // slot of the frame finished last
  std::vector<StageTime> times_;
};

}  // namespace hmlfc::gpu
