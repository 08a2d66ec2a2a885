// The renderer on a Vulkan device with the interface of the renderers on the CPU.
#pragma once

#include <memory>
#include <stdexcept>

#include <hmlfc/gpu/device.hpp>
#include <hmlfc/renderer.hpp>

namespace hmlfc::gpu {

/// Thrown by a renderer of make_gpu_renderer where the machine fails, not the stream: what() is the
/// message of a Failure.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A renderer on `device` of the stream that `decoder` has opened and whose bytes must outlive it.
/// Of `options` it takes cache_bytes alone, as GpuRenderer::open does. It does not count
/// FrameCounts::samples_interpolated; FrameSeconds::sample is the time of the whole frame.
Outcome<std::unique_ptr<FrameRenderer>> make_gpu_renderer(Device device, const Decoder& decoder,
                                                          const RenderOptions& options = {});

}  // namespace hmlfc::gpu
