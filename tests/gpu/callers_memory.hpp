// Buffers, images and commands of a caller.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "gpu/callers_device.hpp"

namespace hmlfc::gpu {

/// Memory of `needs` with `wanted` properties.
vk::raii::DeviceMemory allocate(const CallersDevice& callers, const vk::MemoryRequirements& needs,
                                vk::MemoryPropertyFlags wanted);

/// A buffer that commands copy from and to, and the host sees.
class CallersBuffer {
 public:
  CallersBuffer(const CallersDevice& callers, uint64_t bytes);

  vk::Buffer handle() const { return *buffer_; }
  std::span<uint8_t> bytes() const { return bytes_; }

 private:
  vk::raii::Buffer buffer_;
  vk::raii::DeviceMemory memory_;
  std::span<uint8_t> bytes_;
};

/// An image of one mip level that commands copy from and to.
class CallersImage {
 public:
  CallersImage(const CallersDevice& callers, vk::Format format, uint32_t width, uint32_t height,
               uint32_t layers);

  vk::Image handle() const { return *image_; }
  vk::ImageSubresourceRange all() const {
    return {vk::ImageAspectFlagBits::eColor, 0, 1, 0, layers_};
  }

  /// Everything becomes 0 and the layout TRANSFER_DST_OPTIMAL, before later transfers.
  void clear(const vk::raii::CommandBuffer& commands) const;

  /// All layers to `to`, behind transfers.
  void read(const vk::raii::CommandBuffer& commands, vk::Buffer to) const;

 private:
  vk::Extent3D extent_;
  uint32_t layers_;
  vk::raii::Image image_;
  vk::raii::DeviceMemory memory_;
};

/// Records commands, and runs them when asked to.
class CallersCommands {
 public:
  CallersCommands(const CallersDevice& callers,
                  const std::function<void(const vk::raii::CommandBuffer&)>& record);

  /// Submits them, and waits until they are done and the host sees what they wrote.
  void run() const;

 private:
  const CallersDevice* callers_;
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffer commands_;
};

}  // namespace hmlfc::gpu
