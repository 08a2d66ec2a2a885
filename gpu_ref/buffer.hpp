// Memory of the device, addressed by 64 bits.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "device_state.hpp"
#include "guarded_pages.hpp"

namespace hmlfc::gpu {

enum class Memory : uint8_t {
  kDevice,    ///< for kernels; reached by copies
  kUpload,    ///< written by the host, read by kernels and copies
  kReadback,  ///< written by copies, read by the host
};

/// One buffer with its memory. Throws MachineError where the device has no such memory.
class Buffer {
 public:
  /// Of `bytes` bytes, at least 1; a multiple of 4 is made of it.
  Buffer(Device::State& device, uint64_t bytes, Memory memory);

  uint64_t size() const { return size_; }
  uint64_t address() const { return address_; }
  vk::Buffer handle() const { return *buffer_; }

  /// The bytes as the host sees them; empty for device memory.
  std::span<uint8_t> bytes() const { return {mapped_, mapped_ == nullptr ? 0 : size_}; }

  template <class Record>
  std::span<Record> records() const {
    return {reinterpret_cast<Record*>(mapped_), size_ / sizeof(Record)};
  }

 private:
  void allocate(Device::State& device, const vk::MemoryRequirements& needs, Memory memory);
  void allocate_guarded(Device::State& device, const vk::MemoryRequirements& needs);

  uint64_t size_;
  std::optional<GuardedPages> pages_;
  vk::raii::DeviceMemory memory_;
  vk::raii::Buffer buffer_;
  uint8_t* mapped_ = nullptr;
  uint64_t address_ = 0;
};

}  // namespace hmlfc::gpu
