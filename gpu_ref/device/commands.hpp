// Kernels and copies, written into a command buffer.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "buffer.hpp"
#include "device_state.hpp"

namespace hmlfc::gpu {

/// Greatest number of invocations of one dispatch.
inline constexpr uint64_t kMaxInvocations = uint64_t{1} << 31;

/// Writes commands into a command buffer that the caller owns. barrier() alone orders them, among
/// themselves and after earlier submissions.
class Commands {
 public:
  /// `commands` have begun, outside a render pass. Null: what follows goes to the check of barriers
  /// alone.
  Commands(Device::State& device, vk::CommandBuffer commands);

  /// Has not begun. `frame`, which outlives this, is what Arguments::frame points to; null for
  /// kernels that draw no frame.
  Commands(Device::State& device, const FrameArguments* frame);

  /// Begins, for the first time or again. The times of the stages go to `queries`, which has
  /// 2 * kMaxStages entries; null: they are not taken.
  void begin(vk::CommandBuffer commands, vk::QueryPool queries);

  /// Work of `before` recorded so far ends, and what it wrote becomes visible, before later work of
  /// `after` starts. Both are sums of Work.
  void barrier(unsigned before, unsigned after);

  /// Runs `kernel` in `invocations` invocations, [0, kMaxInvocations]; the times call it a stage.
  void dispatch(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                uint64_t invocations);

  /// Runs `columns` x `rows` workgroups, each at most 65535.
  void dispatch_groups(const std::string& kernel, const Variant& variant,
                       const Arguments& arguments, uint32_t columns, uint32_t rows);

  /// Runs as many workgroups as the three words of `sizes` from byte `offset` on say.
  void dispatch_counted(const std::string& kernel, const Variant& variant,
                        const Arguments& arguments, const Buffer& sizes, uint64_t offset);

  /// Sets the words of bytes [offset, offset + bytes) to `word`; multiples of 4.
  void fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word);

  /// Copies bytes [from_offset, from_offset + bytes) to `to`; does nothing for 0 bytes.
  void copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
            uint64_t bytes);

  /// Tells the check of barriers that the host reads the whole of `buffer` after the run.
  void read_by_host(const Buffer& buffer);

  /// Copies bytes [0, bytes) to byte `offset` of a buffer that the caller owns.
  void copy_out(const Buffer& from, uint64_t bytes, vk::Buffer to, uint64_t offset);

  /// Copies regions to an image in `layout` that the caller owns.
  void copy_out(const Buffer& from, vk::Image to, vk::ImageLayout layout,
                std::span<const vk::BufferImageCopy> regions);

  /// Tells that the host has waited for the last run of these commands, and so for earlier ones.
  void finished();

  /// Ends the check of barriers, if the device has one. Throws MachineError where a barrier is
  /// missing or idle.
  void check() const;

 protected:
  static constexpr uint32_t kMaxStages = 16;
  Device::State* device_;
  std::vector<std::string> stages_;  // stage k has queries 2k and 2k + 1

 private:
  template <class Dispatch>
  void stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
             const Dispatch& dispatch);
  void write_time(uint32_t query);

  const DeviceCalls* calls_;
  const FrameArguments* frame_;
  vk::CommandBuffer commands_;
  vk::QueryPool queries_;
  uint64_t checked_ = 0;  // number of the submission for Hazards
};

}  // namespace hmlfc::gpu
