// The renderers of `hmlfc render`, and what faster settings of them cost in quality.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/renderer.hpp>

#include "cli/view_source.hpp"

namespace hmlfc::cli {

enum class Backend : uint8_t { kCpu, kGpu };

/// The renderer that the command line asks for.
struct BackendChoice {
  Backend backend = Backend::kCpu;
  std::string device;  ///< part of the name of the device of backend gpu; empty: the first
  RenderOptions options;
};

/// The renderer that `choice` asks for; `file` must outlive it. Usage failure if the device is not
/// there or cannot hold the stream; gpu::make_gpu_renderer says what a device ignores.
std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const StreamFile& file);

/// Renders `cameras` with each filter and number of levels, with and without cache, and prints the
/// time and the PSNR of each setting against real frames (docs/rendering.md, section 7) of filter
/// quadrilinear and all levels. Failures: those of rendering.
void print_quality_sweep(const StreamFile& file, std::vector<Camera> cameras,
                         const BackendChoice& choice, bool json);

}  // namespace hmlfc::cli
