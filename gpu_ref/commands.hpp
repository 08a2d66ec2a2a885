// Submissions: kernels and copies in order, with the time of each stage.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "device_state.hpp"
#include "recorder.hpp"

namespace hmlfc::gpu {

/// `device`, which was not lost. Throws MachineError, kLost.
Device::State& usable(Device::State& device);

/// Records commands and runs them, once or again and again.
class Commands : public Recorder {
 public:
  /// Begins to record. `frame` as for Recorder.
  explicit Commands(Device::State& device, const FrameShape* frame = nullptr);
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;
  /// Waits for what was submitted.
  ~Commands();

  /// Begins to record anew. Nothing of this may be under way.
  void restart();

  /// Ends the recording. Throws MachineError where barriers are checked and are not right.
  void end();

  /// Submits what was recorded, without waiting for it.
  void submit();

  /// Whether what was submitted is done.
  bool done();

  /// Waits until it is. Throws MachineError, kTimeout after the device's time.
  void wait();

  /// Keeps the times of the last submission for times().
  void read_times();

  /// The time of each stage when read_times() was called last; none without timestamps.
  std::vector<StageTime> times() const;

  /// end(), submit(), wait(); the times.
  std::vector<StageTime> run();

 private:
  void begin();

  bool pending_ = false;
  std::optional<Device::State::Submission> submission_;
  std::array<uint64_t, 2 * kMaxStages> ticks_{};
  bool timed_ = false;
};

}  // namespace hmlfc::gpu
