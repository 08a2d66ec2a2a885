// The Vulkan headers, for the files that talk to a device.
#pragma once

#include <vulkan/vulkan_raii.hpp>
