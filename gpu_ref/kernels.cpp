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
constexpr uint32_t kMarkCode[] =
#include "shaders/mark.inc"
    ;
constexpr uint32_t kCompactCode[] =
#include "shaders/compact.inc"
    ;
constexpr uint32_t kPlanCode[] =
#include "shaders/plan.inc"
    ;
constexpr uint32_t kErrorsCode[] =
#include "shaders/errors.inc"
    ;
constexpr uint32_t kRenderCode[] =
#include "shaders/render.inc"
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
    case Kernel::kMark:
      return kMarkCode;
    case Kernel::kCompact:
      return kCompactCode;
    case Kernel::kPlan:
      return kPlanCode;
    case Kernel::kErrors:
      return kErrorsCode;
    case Kernel::kRender:
      return kRenderCode;
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
  const std::array<vk::Bool32, 4> values{variant.chunked, variant.reference_pass, variant.stages,
                                         variant.counted};
  std::array<vk::SpecializationMapEntry, 4> entries;
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
