#include "cli/render_backend.hpp"

#include "cli/failure.hpp"

namespace hmlfc::cli {

std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const Decoder& decoder) {
  if (choice.backend == Backend::kGpu) {
    throw Failure(ExitCode::kUsage, "no Vulkan decoder in this build; use --backend cpu");
  }
  if (!choice.device.empty()) throw Failure(ExitCode::kUsage, "--device needs --backend gpu");
  return make_cpu_renderer(decoder, choice.options);
}

}  // namespace hmlfc::cli
