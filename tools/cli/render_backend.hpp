// The renderers that `hmlfc render` can draw with.
#pragma once

#include <memory>
#include <string>

#include <hmlfc/renderer.hpp>

#include "cli/stream_file.hpp"

namespace hmlfc::cli {

enum class Backend : uint8_t { kCpu, kGpu };

/// What the command line says about the renderer.
struct BackendChoice {
  Backend backend = Backend::kCpu;
  std::string device;  ///< part of the name of the device of backend gpu; empty: the first
  RenderOptions options;
};

/// The renderer that `choice` asks for; `file` must outlive it. Usage failure for a device that is
/// not there, or that does not hold the stream; gpu::make_gpu_renderer says what a device ignores.
std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const StreamFile& file);

}  // namespace hmlfc::cli
