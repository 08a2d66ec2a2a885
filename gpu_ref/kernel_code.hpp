// The shaders as SPIR-V.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace hmlfc::gpu {

/// The code of all kernels, by the names of their files in shaders/; none in a build without them.
std::map<std::string, std::span<const uint32_t>> built_kernels();

}  // namespace hmlfc::gpu
