// Stands for recording_cost.cpp in builds without Vulkan.
#include "gpu/host_cost.hpp"

namespace hmlfc::gpu {

Outcome<HostCost> measure_recording(GpuRenderer&, Device&, std::span<const FrameRecord>, uint64_t) {
  return tl::unexpected(Failure{FailureKind::kUnusable, "this build has no GPU renderer"});
}

}  // namespace hmlfc::gpu
