// The messages of Vulkan's validation layer, kept.
#pragma once

#include <string>
#include <vector>

#include "vulkan_hpp.hpp"

namespace hmlfc::gpu {

/// What makes a messenger that adds each warning and error to `messages`, which outlives it.
inline vk::DebugUtilsMessengerCreateInfoEXT keep_messages(std::vector<std::string>& messages) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  vk::DebugUtilsMessengerCreateInfoEXT info;
  info.messageSeverity = Severity::eWarning | Severity::eError;
  info.messageType = Type::eGeneral | Type::eValidation | Type::ePerformance;
  // Vulkan-Hpp calls it with C types, from 1.4 on with its own.
  info.pfnUserCallback = [](auto, auto, const auto* data, void* to) -> VkBool32 {
    static_cast<std::vector<std::string>*>(to)->emplace_back(data->pMessage);
    return VK_FALSE;
  };
  info.pUserData = &messages;
  return info;
}

}  // namespace hmlfc::gpu
