// A Vulkan device that a program has already opened, shared with the decoder.
#pragma once

#include <cstdint>

#include <vulkan/vulkan_core.h>

#include <hmlfc/gpu/device.hpp>

namespace hmlfc::gpu {

/// Handles of the system's loader (libvulkan.so.1).
///
/// Instance and device are made for Vulkan 1.2 or later (VkApplicationInfo::apiVersion), the device
/// with the feature bufferDeviceAddress and no extension, and with a queue of a family that has
/// VK_QUEUE_COMPUTE_BIT.
struct VulkanDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  /// What vkCreateDevice made `device` with, to be checked. Read by open_device alone.
  const VkDeviceCreateInfo* created = nullptr;
  uint32_t queue_family = 0;
  VkQueue queue = VK_NULL_HANDLE;  ///< of this family
};

/// Runs the decoder on the device of `handles`. All of them stay the caller's and outlive the
/// Device, what is opened on it, and recordings. Nobody else may use the queue during a call of
/// this library, which may submit to it; where the device has not answered in time (kTimeout),
/// nobody may use the device while the last of these objects goes. Of `options`, those that choose
/// or make a device must have their defaults: device, validation, guard_pages and
/// kernel_statistics. kUnusable names what is not as above.
Outcome<Device> open_device(const VulkanDevice& handles, const DeviceOptions& options = {});

/// The handles of `device`, also where the library has opened it itself; without `created`.
VulkanDevice vulkan_device(Device& device);

}  // namespace hmlfc::gpu
