// The compute pipelines, each made when it is first needed.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>

#include <vulkan/vulkan_raii.hpp>

#include "device.hpp"

namespace hmlfc::gpu {

/// The specialisation constants of the kernels, in the order of their numbers.
struct Variant {
  bool chunked = false;         ///< kChunked of arguments.glsl
  bool reference_pass = false;  ///< kReferencePass of requests.glsl
  bool stages = false;          ///< kStages of samples.comp
  bool counted = false;         ///< kCounted of frame_arguments.glsl
  bool pool_chunked = false;    ///< kPoolChunked of frame_arguments.glsl

  friend auto operator<=>(const Variant&, const Variant&) = default;
};

/// Invocations of a workgroup of every kernel (arguments.glsl).
inline constexpr uint32_t kWorkgroupSize = 64;

class Kernels {
 public:
  /// `replaced`: DeviceOptions::kernels. Throws MachineError where a name is no kernel's.
  Kernels(const vk::raii::Device& device, KernelCode replaced);

  vk::PipelineLayout layout() const { return *layout_; }

  /// `kernel`: the name of its file in shaders/.
  vk::Pipeline pipeline(const std::string& kernel, const Variant& variant);

 private:
  const vk::raii::Device* device_;
  vk::raii::PipelineLayout layout_;
  std::map<std::string, std::span<const uint32_t>> code_;
  KernelCode replaced_;
  std::map<std::pair<std::string, Variant>, vk::raii::Pipeline> pipelines_;
};

}  // namespace hmlfc::gpu
