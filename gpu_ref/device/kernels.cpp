#include "kernels.hpp"

#include <array>
#include <string_view>
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
constexpr uint32_t kSurfaceCode[] =
#include "shaders/surface.inc"
    ;
constexpr uint32_t kMarkCode[] =
#include "shaders/mark.inc"
    ;
constexpr uint32_t kCompactCode[] =
#include "shaders/compact.inc"
    ;
constexpr uint32_t kRenderCode[] =
#include "shaders/render.inc"
    ;

// By the names of their files in shaders/.
std::map<std::string, std::span<const uint32_t>> built_kernels() {
  return {{"expand", kExpandCode},   {"walk", kWalkCode},       {"residuals", kResidualsCode},
          {"samples", kSamplesCode}, {"colour", kColourCode},   {"surface", kSurfaceCode},
          {"mark", kMarkCode},       {"compact", kCompactCode}, {"render", kRenderCode}};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device) {
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Arguments));
  return {device, vk::PipelineLayoutCreateInfo({}, {}, range)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device,
                                 const vk::raii::PipelineCache& cache, vk::PipelineLayout layout,
                                 std::span<const uint32_t> code, const Variant& variant) {
  const vk::raii::ShaderModule shader(
      device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
  const std::array<vk::Bool32, 7> values{variant.chunked, variant.reference_pass, variant.stages,
                                         variant.counted, variant.pool_chunked,   variant.geometry,
                                         variant.texels};
  std::array<vk::SpecializationMapEntry, values.size()> entries;
  for (uint32_t i = 0; i < entries.size(); ++i) {
    entries[i] =
        vk::SpecializationMapEntry(i, i * uint32_t{sizeof(vk::Bool32)}, sizeof(vk::Bool32));
  }
  const vk::SpecializationInfo constants(static_cast<uint32_t>(entries.size()), entries.data(),
                                         sizeof(values), values.data());
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader,
                                                "main", &constants);
  return {device, cache, vk::ComputePipelineCreateInfo({}, stage, layout)};
}

// The names of the kernels that `use` dispatches.
std::span<const std::string_view> kernels_of(KernelUse use) {
  static constexpr std::string_view kReferences[] = {"expand", "walk", "residuals"};
  static constexpr std::string_view kBlocks[] = {"expand", "walk", "samples", "colour"};
  static constexpr std::string_view kStages[] = {"samples"};
  static constexpr std::string_view kFrames[] = {"mark", "compact", "walk", "samples", "render"};
  static constexpr std::string_view kGeometry[] = {"surface", "mark", "compact", "render"};
  static constexpr std::string_view kTexels[] = {"colour"};
  static constexpr std::string_view kFrameTexels[] = {"render"};
  switch (use) {
    case KernelUse::kReferences:
      return kReferences;
    case KernelUse::kBlocks:
      return kBlocks;
    case KernelUse::kStages:
      return kStages;
    case KernelUse::kFrames:
      return kFrames;
    case KernelUse::kGeometry:
      return kGeometry;
    case KernelUse::kTexels:
      return kTexels;
    case KernelUse::kFrameTexels:
    case KernelUse::kGeometryTexels:
      return kFrameTexels;
  }
  return {};
}

std::filesystem::path cache_folder(const DeviceOptions& options) {
  return options.cache_folder ? std::filesystem::path(*options.cache_folder)
                              : default_cache_folder();
}

}  // namespace

Variant variant_of(KernelUse use, bool chunked, bool pool_chunked) {
  const bool geometry = use == KernelUse::kGeometry || use == KernelUse::kGeometryTexels;
  const bool frames = geometry || use == KernelUse::kFrames || use == KernelUse::kFrameTexels;
  return {.chunked = chunked,
          .reference_pass = use == KernelUse::kReferences,
          .stages = use == KernelUse::kStages,
          .counted = frames,
          .pool_chunked = frames && pool_chunked,
          .geometry = geometry,
          .texels = use == KernelUse::kTexels || use == KernelUse::kFrameTexels ||
                    use == KernelUse::kGeometryTexels};
}

Kernels::Kernels(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                 const DeviceOptions& options)
    : device_(&device),
      layout_(make_layout(device)),
      code_(built_kernels()),
      replaced_(options.kernels),
      file_(cache_folder(options), physical.getProperties()),
      kept_(file_.read()),
      cache_(device, vk::PipelineCacheCreateInfo({}, kept_.size(), kept_.data())) {
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
    found = pipelines_
                .emplace(key, make_pipeline(*device_, cache_, *layout_, code_.at(kernel), variant))
                .first;
  }
  return *found->second;
}

void Kernels::prepare(KernelUse use, bool chunked, bool pool_chunked) {
  const size_t before = pipelines_.size();
  for (const std::string_view kernel : kernels_of(use)) {
    pipeline(std::string(kernel), variant_of(use, chunked, pool_chunked));
  }
  if (pipelines_.size() == before) return;
  auto data = cache_.getData();
  if (data == kept_) return;
  file_.write(data);
  kept_ = std::move(data);
}

}  // namespace hmlfc::gpu
