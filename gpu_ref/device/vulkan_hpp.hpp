// Vulkan-Hpp, in a namespace of this library.
#pragma once

// A program that links the library may use Vulkan-Hpp as well, compiled with other macros: NDEBUG
// changes the layout of its classes. Functions of one must not stand in for those of the other.
#define VULKAN_HPP_NAMESPACE hmlfc_vk
#include <vulkan/vulkan_raii.hpp>

namespace vk = hmlfc_vk;
