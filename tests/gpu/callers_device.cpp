#include "gpu/callers_device.hpp"

#include <algorithm>
#include <stdexcept>

#include "device/kept_messages.hpp"

namespace hmlfc::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

}  // namespace

CallersDevice::CallersDevice(const std::string& name, const CallersOptions& options) {
  make_instance(options);
  for (vk::raii::PhysicalDevice& physical : instance_->enumeratePhysicalDevices()) {
    if (name == physical.getProperties().deviceName.data()) physical_.emplace(std::move(physical));
  }
  if (!physical_) throw std::runtime_error("no device is called " + name);
  make_device(options);
}

void CallersDevice::make_instance(const CallersOptions& options) {
  const vk::ApplicationInfo application("caller", 1, nullptr, 0, options.version);
  const auto layers = context_.enumerateInstanceLayerProperties();
  const bool validated = std::ranges::any_of(layers, [](const vk::LayerProperties& layer) {
    return std::string(kValidationLayer) == layer.layerName.data();
  });
  std::vector<const char*> names;
  std::vector<const char*> extensions;
  const auto synchronisation = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features(synchronisation);
  if (validated) {
    names.push_back(kValidationLayer);
    extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  }
  vk::InstanceCreateInfo info({}, &application, names, extensions);
  if (validated) info.setPNext(&features);
  instance_.emplace(context_, info);
  if (!validated) return;
  messenger_.emplace(*instance_, keep_messages(messages_));
}

void CallersDevice::make_device(const CallersOptions& options) {
  const auto families = physical_->getQueueFamilyProperties();
  while (!(families.at(family_).queueFlags & vk::QueueFlagBits::eCompute)) ++family_;
  queue_info_ = vk::DeviceQueueCreateInfo({}, family_, 1, &priority_);
  info_ = vk::DeviceCreateInfo({}, queue_info_);
  addresses_.bufferDeviceAddress = options.addresses ? VK_TRUE : VK_FALSE;
  features12_.bufferDeviceAddress = addresses_.bufferDeviceAddress;
  if (options.features12) {
    info_.setPNext(&features12_);
  } else {
    info_.setPNext(&addresses_);
  }
  device_.emplace(*physical_, info_);
  queue_.emplace(*device_, family_, 0);
}

VulkanDevice CallersDevice::handles() const {
  const VkDeviceCreateInfo& created = info_;
  return {**instance_, **physical_, **device_, &created, family_, **queue_};
}

}  // namespace hmlfc::gpu
