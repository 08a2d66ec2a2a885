#include "cli/render_backend.hpp"

#include <chrono>
#include <utility>

#include "cli/failure.hpp"
#include "decoder/open_stream.hpp"
#include "gpu_ref/device.hpp"
#include "gpu_ref/gpu_renderer.hpp"

namespace hmlfc::cli {
namespace {

template <class T>
T device_value(gpu::Outcome<T> outcome) {
  if (!outcome) throw Failure(ExitCode::kUsage, "--backend gpu: " + outcome.error().message);
  return std::move(*outcome);
}

// The stream as the device takes it up; its sections were checked where that was asked for.
StreamView view_of(const StreamFile& file) {
  OpenOptions options;
  options.check_sections = false;
  return value_or_throw(open_stream(file.bytes(), options), file.path());
}

// A device as a renderer like the one on the CPU.
class GpuBackend final : public FrameRenderer {
 public:
  GpuBackend(gpu::Device device, const StreamFile& file, const RenderOptions& options)
      : device_(std::move(device)),
        renderer_(device_value(
            gpu::GpuRenderer::open(device_, view_of(file), uint64_t{options.cache_bytes}))) {}

  Result<void> render(const FrameRecord& record, int stop_level, Frame& frame) override {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    gpu::GpuFrame drawn = device_value(renderer_.render(record, stop_level));
    if (drawn.status != ErrorCode::kOk) return fail(drawn.status, Section::kTile, 0);
    frame.image = std::move(drawn.image);
    frame.counts = {drawn.blocks_needed, drawn.blocks_decoded,
                    drawn.blocks_needed - drawn.blocks_decoded, 0};
    frame.seconds = {};
    frame.seconds.sample = std::chrono::duration<double>(Clock::now() - begin).count();
    return {};
  }

 private:
  gpu::Device device_;
  gpu::GpuRenderer renderer_;
};

}  // namespace

std::unique_ptr<FrameRenderer> make_renderer(const BackendChoice& choice, const StreamFile& file) {
  if (choice.backend == Backend::kGpu) {
    gpu::DeviceOptions options;
    options.device = choice.device;
    return std::make_unique<GpuBackend>(device_value(gpu::Device::open(options)), file,
                                        choice.options);
  }
  if (!choice.device.empty()) throw Failure(ExitCode::kUsage, "--device needs --backend gpu");
  return make_cpu_renderer(file.decoder(), choice.options);
}

}  // namespace hmlfc::cli
