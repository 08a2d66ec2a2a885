#include "kernels.hpp"

#include <array>
#include <span>

#include "arguments.hpp"

namespace hmlfc::gpu {
namespace {

// The shaders as SPIR-V, written by glslc.
constexpr uint32_t kExpandCode[] =
#include "shaders/expand.inc"
    ;
constexpr uint32_t kWalkCode[] =
#include "shaders/walk.inc"
    ;
constexpr uint32_t kResidualsCode[] =
#include "shaders/residuals.inc"
    ;
constexpr uint32_t kSamplesCode[] =
#include "shaders/samples.inc"
    ;
constexpr uint32_t kColourCode[] =
#include "shaders/colour.inc"
    ;

std::span<const uint32_t> code_of(Kernel kernel) {
  switch (kernel) {
    case Kernel::kExpand:
      return kExpandCode;
    case Kernel::kWalk:
      return kWalkCode;
    case Kernel::kResiduals:
      return kResidualsCode;
    case Kernel::kSamples:
      return kSamplesCode;
    case Kernel::kColour:
      return kColourCode;
  }
  return {};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device) {
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Arguments));
  return {device, vk::PipelineLayoutCreateInfo({}, {}, range)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, vk::PipelineLayout layout,
                                 std::span<const uint32_t> code, const Variant& variant) {
  const vk::raii::ShaderModule shader(
      device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
  const std::array<vk::Bool32, 3> values{variant.chunked, variant.reference_pass, variant.stages};
  std::array<vk::SpecializationMapEntry, 3> entries;
  for (uint32_t i = 0; i < entries.size(); ++i) {
    entries[i] =
        vk::SpecializationMapEntry(i, i * uint32_t{sizeof(vk::Bool32)}, sizeof(vk::Bool32));
  }
  const vk::SpecializationInfo constants(static_cast<uint32_t>(entries.size()), entries.data(),
                                         sizeof(values), values.data());
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader,
                                                "main", &constants);
  return {device, nullptr, vk::ComputePipelineCreateInfo({}, stage, layout)};
}

}  // namespace

Kernels::Kernels(const vk::raii::Device& device) : device_(&device), layout_(make_layout(device)) {}

vk::Pipeline Kernels::pipeline(Kernel kernel, const Variant& variant) {
  const auto key = std::pair{kernel, variant};
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    found =
        pipelines_.emplace(key, make_pipeline(*device_, *layout_, code_of(kernel), variant)).first;
  }
  return *found->second;
}

}  // namespace hmlfc::gpu
