// A Vulkan device that a program has already opened, shared with the decoder.
#pragma once

#include <cstdint>

#include <vulkan/vulkan_core.h>

#include <hmlfc/gpu/device.hpp>

namespace hmlfc::gpu {

/// A piece of the program's device memory.
struct MemoryPiece {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< where the piece begins
  void* mapped = nullptr;   ///< the piece as the host sees it
  void* handle = nullptr;   ///< the program's own, for `free`
};

/// Device memory from the program, such as VMA's, instead of vkAllocateMemory: one piece for each
/// buffer of this library. Called in calls of this library and where its objects go.
struct MemoryCallbacks {
  void* user = nullptr;

  /// A piece as `needs` says, of memory that was allocated with
  /// VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT. Its type has the properties `required`, and those of
  /// `preferred` if possible. It stays mapped where VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT is
  /// required. A result other than VK_SUCCESS is kOutOfMemory, and there is no piece.
  VkResult (*allocate)(void* user, const VkMemoryRequirements& needs,
                       VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                       MemoryPiece& piece) = nullptr;

  /// Takes back a piece, to which nothing is bound any more.
  void (*free)(void* user, const MemoryPiece& piece) = nullptr;
};

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
  /// Both functions, or neither: then the library allocates. They outlive what they are for.
  MemoryCallbacks memory{};
};

/// Runs the decoder on the device of `handles`. All of them stay the caller's and outlive the
/// Device, what is opened on it, and recordings. Nobody else may use the queue during a call of
/// this library, which may submit to it; where the device has not answered in time (kTimeout),
/// nobody may use the device while the last of these objects goes. Of `options`, those that choose
/// or make a device must have their defaults: device, validation and guard_pages. kUnusable names
/// what is not as above.
Outcome<Device> open_device(const VulkanDevice& handles, const DeviceOptions& options = {});

/// The handles of `device`, also where the library has opened it itself; without `created`.
VulkanDevice vulkan_device(Device& device);

}  // namespace hmlfc::gpu
