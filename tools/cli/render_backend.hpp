// The renderers of `hmlfc render`, and what faster settings of them cost in quality.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/renderer.hpp>

#include "cli/view_source.hpp"
#include "io/parallel.hpp"

namespace hmlfc::cli {

enum class Backend : uint8_t { kCpu, kGpu };

/// The renderer that the command line asks for.
struct BackendChoice {
  Backend backend = Backend::kCpu;
  std::string device;  ///< part of the name of the device of backend gpu; empty: the first
  RenderOptions options;
};

/// The renderer that `choice` asks for; `file` must outlive it. Usage failure if the device is not
/// there or cannot hold the stream; gpu::make_gpu_renderer says what
/// a device ignores.
std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const StreamFile& file);

/// One setting, over all frames of a path, compared with real frames (docs/rendering.md, section 7)
/// of filter quadrilinear and all levels.
struct SweepPoint {
  Filter filter = Filter::kQuadrilinear;
  int levels = 1;       ///< of the tree, from the top
  bool cached = false;  ///< blocks are kept between frames
  double seconds = 0;   ///< per frame, wall clock
  double psnr = 0;      ///< over RGB, dB
};

/// Renders `cameras` with each filter and number of levels, with and without cache. Failures: those
/// of rendering.
std::vector<SweepPoint> sweep_quality(const StreamFile& file, std::vector<Camera> cameras,
                                      const BackendChoice& choice, const io::Progress& progress);

}  // namespace hmlfc::cli
