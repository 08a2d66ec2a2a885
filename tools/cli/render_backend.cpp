#include "cli/render_backend.hpp"

#include <utility>

#include "cli/failure.hpp"
#include "gpu_ref/frame_renderer.hpp"

namespace hmlfc::cli {
namespace {

template <class T>
T device_value(gpu::Outcome<T> outcome) {
  if (!outcome) throw Failure(ExitCode::kUsage, "--backend gpu: " + outcome.error().message);
  return std::move(*outcome);
}

}  // namespace

std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const StreamFile& file) {
  if (choice.backend == Backend::kGpu) {
    gpu::DeviceOptions options;
    options.device = choice.device;
    return device_value(gpu::make_gpu_renderer(device_value(gpu::Device::open(options)),
                                               file.decoder(), choice.options));
  }
  if (!choice.device.empty()) throw Failure(ExitCode::kUsage, "--device needs --backend gpu");
  return make_cpu_renderer(file.decoder(), choice.options);
}

}  // namespace hmlfc::cli
