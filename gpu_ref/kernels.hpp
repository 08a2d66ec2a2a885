// The compute pipelines, each made when it is first needed.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "vulkan.hpp"

namespace hmlfc::gpu {

enum class Kernel : uint8_t {
  kExpand,
  kWalk,
  kResiduals,
  kSamples,
  kColour,
  kMark,
  kCompact,
  kPlan,
  kErrors,
  kRender
};

/// The specialisation constants of the kernels, in the order of their numbers.
struct Variant {
  bool chunked = false;         ///< kChunked of arguments.glsl
  bool reference_pass = false;  ///< kReferencePass of requests.glsl
  bool stages = false;          ///< kStages of samples.comp
  bool counted = false;         ///< kCounted of frame_arguments.glsl

  friend auto operator<=>(const Variant&, const Variant&) = default;
};

/// Invocations of a workgroup of every kernel (arguments.glsl).
inline constexpr uint32_t kGroupSize = 64;

class Kernels {
 public:
  explicit Kernels(const vk::raii::Device& device);

  vk::PipelineLayout layout() const { return *layout_; }
  vk::Pipeline pipeline(Kernel kernel, const Variant& variant);

 private:
  const vk::raii::Device* device_;
  vk::raii::PipelineLayout layout_;
  std::map<std::pair<Kernel, Variant>, vk::raii::Pipeline> pipelines_;
};

}  // namespace hmlfc::gpu
