// Records kernels and copies into a command buffer.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "buffer.hpp"
#include "device_state.hpp"

namespace hmlfc::gpu {

struct FrameShape;

/// Greatest number of invocations of one dispatch.
inline constexpr uint64_t kMaxInvocations = uint64_t{1} << 31;

/// Records into a command buffer of whomever. Among themselves, and after earlier submissions, the
/// commands are ordered by barrier() alone.
class Recorder {
 public:
  /// `commands` have begun, outside a render pass; null: the check of barriers alone sees what
  /// follows.
  Recorder(Device::State& device, vk::CommandBuffer commands);

  /// Has not begun. `frame` is what arguments.frame points to, for the kernels of a frame. It
  /// outlives this.
  Recorder(Device::State& device, const FrameShape* frame);

  /// Begins, once more or for the first time: times of stages go to `queries`, 2 * kMaxStages of
  /// them; null: nowhere.
  void begin(vk::CommandBuffer commands, vk::QueryPool queries);

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

  /// Bytes [0, bytes) to byte `offset` of a buffer that is not this library's.
  void copy_out(const Buffer& from, uint64_t bytes, vk::Buffer to, uint64_t offset);

  /// The same to an image in `layout`, by regions.
  void copy_out(const Buffer& from, vk::Image to, vk::ImageLayout layout,
                std::span<const vk::BufferImageCopy> regions);

  /// The host has waited for the last run of what was recorded, and so for those before it.
  void finished();

  /// No more follows. Throws MachineError where barriers are checked and are not right.
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

  const vk::raii::DeviceDispatcher* calls_;
  const FrameShape* frame_;
  vk::CommandBuffer commands_;
  vk::QueryPool queries_;
  unsigned barriers_ = 0;
  uint64_t checked_ = 0;  // number of the submission for Hazards
};

}  // namespace hmlfc::gpu
