#include "kernels.hpp"

#include <array>
#include <utility>

#include "arguments.hpp"
#include "device_state.hpp"

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
constexpr uint32_t kCountCode[] =
#include "shaders/count.inc"
    ;
constexpr uint32_t kPlanCode[] =
#include "shaders/plan.inc"
    ;
constexpr uint32_t kCompactCode[] =
#include "shaders/compact.inc"
    ;
constexpr uint32_t kErrorsCode[] =
#include "shaders/errors.inc"
    ;
constexpr uint32_t kRenderCode[] =
#include "shaders/render.inc"
    ;

std::map<std::string, std::span<const uint32_t>> built_kernels() {
  return {{"expand", kExpandCode},   {"walk", kWalkCode},     {"residuals", kResidualsCode},
          {"samples", kSamplesCode}, {"colour", kColourCode}, {"mark", kMarkCode},
          {"count", kCountCode},     {"plan", kPlanCode},     {"compact", kCompactCode},
          {"errors", kErrorsCode},   {"render", kRenderCode}};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device) {
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Arguments));
  return {device, vk::PipelineLayoutCreateInfo({}, {}, range)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, vk::PipelineLayout layout,
                                 std::span<const uint32_t> code, const Variant& variant) {
  const vk::raii::ShaderModule shader(
      device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
  const std::array<vk::Bool32, 5> values{variant.chunked, variant.reference_pass, variant.stages,
                                         variant.counted, variant.pool_chunked};
  std::array<vk::SpecializationMapEntry, 5> entries;
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

Kernels::Kernels(const vk::raii::Device& device, KernelCode replaced)
    : device_(&device),
      layout_(make_layout(device)),
      code_(built_kernels()),
      replaced_(std::move(replaced)) {
  for (const auto& [name, code] : replaced_) {
    if (!code_.contains(name))
      throw MachineError(FailureKind::kUnusable, "no kernel is named \"" + name + "\"");
    code_[name] = code;
  }
}

vk::Pipeline Kernels::pipeline(const std::string& kernel, const Variant& variant) {
  const auto key = std::pair{kernel, variant};
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    found =
        pipelines_.emplace(key, make_pipeline(*device_, *layout_, code_.at(kernel), variant)).first;
  }
  return *found->second;
}

}  // namespace hmlfc::gpu
