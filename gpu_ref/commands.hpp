// Submissions: kernels and copies in order, with the time of each stage.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "arguments.hpp"
#include "buffer.hpp"
#include "device_state.hpp"

namespace hmlfc::gpu {

struct FrameShape;

/// Greatest number of invocations of one dispatch.
inline constexpr uint64_t kMaxInvocations = uint64_t{1} << 31;

/// Records commands and runs them, once or again and again. Among themselves, and after earlier
/// submissions, they are ordered by barrier() alone.
class Commands {
 public:
  /// Begins to record. `frame` is what arguments.frame points to, for the kernels of a frame. It
  /// outlives this.
  explicit Commands(Device::State& device, const FrameShape* frame = nullptr);
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;
  /// Waits for what was submitted.
  ~Commands();

  /// Begins to record anew. Nothing of this may be under way.
  void restart();

  /// Work of `before` so far ends, and what it wrote is visible, before work of `after` that
  /// follows: sums of Work.
  void barrier(unsigned before, unsigned after);

  /// `invocations` invocations, in [0, kMaxInvocations], as the stage `kernel` of the times.
  void dispatch(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                uint64_t invocations);

  /// `columns` times `rows` workgroups, each at most 65535.
  void dispatch_groups(const std::string& kernel, const Variant& variant,
                       const Arguments& arguments, uint32_t columns, uint32_t rows);

  /// As many workgroups as the three words of `sizes` from byte `offset` on say.
  void dispatch_counted(const std::string& kernel, const Variant& variant,
                        const Arguments& arguments, const Buffer& sizes, uint64_t offset);

  /// Sets the words of bytes [offset, offset + bytes) to `word`; multiples of 4.
  void fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word);

  /// Bytes [from_offset, from_offset + bytes) to `to`; nothing for 0 bytes.
  void copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
            uint64_t bytes);

  /// The host will read the whole of `buffer` after wait().
  void read_by_host(const Buffer& buffer);

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
  static constexpr uint32_t kMaxStages = 16;

  template <class Dispatch>
  void stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
             const Dispatch& dispatch);
  void begin();
  void write_time(uint32_t query);

  Device::State* device_;
  const FrameShape* frame_;
  unsigned barriers_ = 0;
  bool pending_ = false;
  uint64_t checked_ = 0;  // number of the submission for Hazards
  std::optional<Device::State::Submission> submission_;
  std::vector<std::string> stages_;  // stage k has queries 2k and 2k + 1
  std::array<uint64_t, 2 * kMaxStages> ticks_{};
  bool timed_ = false;
};

}  // namespace hmlfc::gpu
