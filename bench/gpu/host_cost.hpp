// What frames cost the host while the device draws others.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <hmlfc/gpu/renderer.hpp>

namespace hmlfc::gpu {

/// Of frames that stay on the device, with GpuRenderer::most_under_way() under way.
struct HostCost {
  uint64_t frames = 0;
  double cpu_seconds = 0;     ///< of the calling thread, in what makes frames alone
  SubmissionCounts counts{};  ///< of these frames
};

/// Draws the frames of `records` once to begin with, and counts `frames` more of them. Waits, which
/// are none of the renderer's, are for ready() to be true.
Outcome<HostCost> measure_host(GpuRenderer& renderer, const Device& device,
                               std::span<const FrameRecord> records, uint64_t frames);

/// The same of frames recorded into command buffers of a program: CPU time in record() alone.
Outcome<HostCost> measure_recording(GpuRenderer& renderer, Device& device,
                                    std::span<const FrameRecord> records, uint64_t frames);

/// `what`: of which frames.
std::string to_text(const HostCost& cost, const std::string& what);

}  // namespace hmlfc::gpu
