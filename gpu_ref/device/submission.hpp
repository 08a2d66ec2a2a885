// Submissions to the queue of the device, with the time of each stage.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "commands.hpp"
#include "device_state.hpp"

namespace hmlfc::gpu {

/// Returns `device`. Throws MachineError, kLost, where it was lost.
Device::State& usable(Device::State& device);

/// Commands that are submitted, once or again and again.
class Submission : public Commands {
 public:
  /// Begins. `frame` as for Commands.
  explicit Submission(Device::State& device, const FrameArguments* frame = nullptr);
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;
  /// Waits for what was submitted.
  ~Submission();

  /// Begins anew. The last run must be over.
  void restart();

  /// Ends the commands. Throws MachineError as check() does.
  void end();

  /// Submits the commands and does not wait for them.
  void submit();

  /// Returns whether the last run is over.
  bool done();

  /// Waits until the last run is over. Throws MachineError, kTimeout after the device's timeout.
  void wait();

  /// Keeps the times of the last submission for times().
  void read_times();

  /// The time of each stage when read_times() was called last; none without timestamps.
  std::vector<StageTime> times() const;

  /// Calls end(), submit() and wait(), and returns the times.
  std::vector<StageTime> run();

 private:
  void begin();

  bool pending_ = false;
  std::optional<Device::State::SubmissionHandles> handles_;
  std::array<uint64_t, 2 * kMaxStages> ticks_{};
  bool timed_ = false;
};

}  // namespace hmlfc::gpu
