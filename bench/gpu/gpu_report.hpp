// The figures of ./run bench gpu as tables or as JSON.
#pragma once

#include <span>
#include <string>

#include <hmlfc/gpu/device.hpp>

#include "gpu/gpu_speed.hpp"

namespace hmlfc::bench {

/// What the device is, what the figures are beside, and a table of each stream.
std::string to_text(const gpu::DeviceInfo& device, std::span<const StreamSpeed> streams);

std::string to_json(const gpu::DeviceInfo& device, std::span<const StreamSpeed> streams);

}  // namespace hmlfc::bench
