// A Vulkan device as a program has it that shares it with the decoder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <hmlfc/gpu/vulkan_device.hpp>

#include "device/vulkan_hpp.hpp"

namespace hmlfc::gpu {

/// How a program makes its device.
struct CallersOptions {
  uint32_t version = VK_API_VERSION_1_2;
  bool addresses = true;    ///< the feature bufferDeviceAddress is on
  bool features12 = false;  ///< it stands in VkPhysicalDeviceVulkan12Features
};

/// Instance, device and a queue of the physical device called `name`. Throws vk::Error.
class CallersDevice {
 public:
  explicit CallersDevice(const std::string& name, const CallersOptions& options = {});
  CallersDevice(const CallersDevice&) = delete;
  CallersDevice& operator=(const CallersDevice&) = delete;

  /// For open_device().
  VulkanDevice handles() const;

  const vk::raii::Device& device() const { return *device_; }
  const vk::raii::PhysicalDevice& physical() const { return *physical_; }
  const vk::raii::Queue& queue() const { return *queue_; }
  uint32_t family() const { return family_; }

  /// What the validation layer has said.
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  void make_instance(const CallersOptions& options);
  void make_device(const CallersOptions& options);

  vk::raii::Context context_;
  std::vector<std::string> messages_;
  std::optional<vk::raii::Instance> instance_;
  std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
  std::optional<vk::raii::PhysicalDevice> physical_;
  uint32_t family_ = 0;
  float priority_ = 1;
  vk::DeviceQueueCreateInfo queue_info_;
  vk::PhysicalDeviceBufferDeviceAddressFeatures addresses_;
  vk::PhysicalDeviceVulkan12Features features12_;
  vk::DeviceCreateInfo info_;
  std::optional<vk::raii::Device> device_;
  std::optional<vk::raii::Queue> queue_;
};

}  // namespace hmlfc::gpu
