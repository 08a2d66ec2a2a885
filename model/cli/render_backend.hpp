// The renderers that `hmlfc render` can draw with.
#pragma once

#include <memory>
#include <string>

#include <hmlfc/renderer.hpp>

namespace hmlfc::cli {

enum class Backend : uint8_t { kCpu, kGpu };

/// What the command line says about the renderer.
struct BackendChoice {
  Backend backend = Backend::kCpu;
  std::string device;  ///< part of the name of the device of backend gpu; empty: the first
  RenderOptions options;
};

/// The renderer that `choice` asks for; `decoder` must outlive it. Usage failure for what this
/// build does not have.
std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const Decoder& decoder);

}  // namespace hmlfc::cli
