// One submission: kernels and copies in order, with the time of each stage.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "buffer.hpp"
#include "device_state.hpp"
#include "gpu_decoder.hpp"

namespace hmlfc::gpu {

struct FrameShape;

/// Greatest number of invocations of one dispatch.
inline constexpr uint64_t kMaxInvocations = uint64_t{1} << 31;

/// Records commands and runs them once. They see what earlier submissions wrote; among themselves
/// they are ordered by barrier() alone.
class Commands {
 public:
  /// `frame` is what arguments.frame points to, for the kernels of a frame. It outlives this.
  explicit Commands(Device::State& device, const FrameShape* frame = nullptr);

  /// Work of `before` so far ends, and what it wrote is visible, before work of `after` that
  /// follows: sums of Work.
  void barrier(unsigned before, unsigned after);

  /// `invocations` invocations, in [0, kMaxInvocations], as the stage `kernel` of the times.
  void dispatch(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                uint64_t invocations);

  /// As many workgroups as the three words of `sizes` from byte `offset` on say.
  void dispatch_counted(const std::string& kernel, const Variant& variant,
                        const Arguments& arguments, const Buffer& sizes, uint64_t offset);

  /// Writes `bytes`, a multiple of 4 and at most 65536 of them, to the beginning of `buffer`.
  void write(const Buffer& buffer, std::span<const uint8_t> bytes);

  /// Sets the words of bytes [offset, offset + bytes) to `word`; multiples of 4.
  void fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word);

  /// Bytes [from_offset, from_offset + bytes) to `to`; nothing for 0 bytes.
  void copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
            uint64_t bytes);

  /// The host will read the whole of `buffer` after run().
  void read_by_host(const Buffer& buffer);

  /// Submits everything, waits, and returns the time of each stage; none without timestamps. Throws
  /// MachineError, kTimeout after the device's time.
  std::vector<StageTime> run();

 private:
  template <class Dispatch>
  void stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
             const Dispatch& dispatch);
  void submit();
  void write_time(uint32_t query);

  Device::State* device_;
  const FrameShape* frame_;
  unsigned barriers_ = 0;
  vk::raii::CommandBuffer buffer_;
  vk::raii::QueryPool queries_;
  std::vector<std::string> stages_;  // stage k has queries 2k and 2k + 1
};

}  // namespace hmlfc::gpu
