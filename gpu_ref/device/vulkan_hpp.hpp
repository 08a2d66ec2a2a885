// Vulkan-Hpp, in a namespace of this library.
#pragma once

#include <utility>

// A program that links the library may use Vulkan-Hpp as well, compiled with other macros: NDEBUG
// changes the layout of its classes. Functions of one must not stand in for those of the other.
#define VULKAN_HPP_NAMESPACE hmlfc_vk
namespace hmlfc_vk {}
namespace vk = hmlfc_vk;  // newer headers write `vk` out in places
#include <vulkan/vulkan_raii.hpp>

namespace hmlfc::gpu {

/// The functions of a device, whose class has another name in each release.
using DeviceCalls =
    std::remove_cvref_t<decltype(*std::declval<const vk::raii::Device&>().getDispatcher())>;

}  // namespace hmlfc::gpu
