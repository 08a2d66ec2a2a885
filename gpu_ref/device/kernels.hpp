// The compute pipelines, each made when it is first needed.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <hmlfc/gpu/device.hpp>

#include "kernel_cache.hpp"
#include "vulkan_hpp.hpp"

namespace hmlfc::gpu {

/// The specialisation constants of the kernels, in the order of their numbers.
struct Variant {
  bool chunked = false;         ///< kChunked of arguments.glsl
  bool reference_pass = false;  ///< kReferencePass of requests.glsl
  bool stages = false;          ///< kStages of samples.comp
  bool counted = false;         ///< kCounted of frame_arguments.glsl
  bool pool_chunked = false;    ///< kPoolChunked of frame_arguments.glsl
  bool geometry = false;        ///< kGeometry of frame_arguments.glsl
  bool texels = false;          ///< kTexels of texels.glsl

  friend auto operator<=>(const Variant&, const Variant&) = default;
};

/// Invocations of a workgroup of every kernel (arguments.glsl).
inline constexpr uint32_t kWorkgroupSize = 64;

/// What kernels are dispatched for.
enum class KernelUse : uint8_t {
  kReferences,      ///< reference images, when a stream is opened
  kBlocks,          ///< blocks and pixels
  kStages,          ///< stages of blocks, besides kBlocks
  kFrames,          ///< frames of a renderer
  kGeometry,        ///< frames with geometry, besides kFrames
  kTexels,          ///< pixels as texels, besides kBlocks
  kFrameTexels,     ///< frames as texels, besides kFrames
  kGeometryTexels,  ///< the same with geometry, besides kGeometry
};

/// Returns the variant of every kernel of `use`. Only kernels of frames depend on `pool_chunked`.
Variant variant_of(KernelUse use, bool chunked, bool pool_chunked = false);

class Kernels {
 public:
  /// Throws MachineError where DeviceOptions::kernels has a name that is no kernel's.
  Kernels(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
          const DeviceOptions& options);

  vk::PipelineLayout layout() const { return *layout_; }

  /// Returns the pipeline of `kernel`, the name of its file in shaders/.
  vk::Pipeline pipeline(const std::string& kernel, const Variant& variant);

  /// Makes the pipelines of `use`, so that no call waits for a compiler, and keeps what was
  /// compiled for the next process.
  void prepare(KernelUse use, bool chunked, bool pool_chunked = false);

 private:
  const vk::raii::Device* device_;
  vk::raii::PipelineLayout layout_;
  std::map<std::string, std::span<const uint32_t>> code_;
  KernelCode replaced_;
  KernelCacheFile file_;
  std::vector<uint8_t> kept_;  // what the file has, as far as is known
  vk::raii::PipelineCache cache_;
  std::map<std::pair<std::string, Variant>, vk::raii::Pipeline> pipelines_;
};

}  // namespace hmlfc::gpu
