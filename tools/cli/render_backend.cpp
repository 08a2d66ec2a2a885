#include "cli/render_backend.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "cli/output.hpp"
#include "decoder/open_stream.hpp"
#include "gpu_ref/device.hpp"
#include "gpu_ref/gpu_renderer.hpp"
#include "render/real_renderer.hpp"

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

FrameRecord record_of(const Camera& camera, const StreamHeader& header) {
  const auto record = frame_record(camera, header);
  if (!record) throw Failure(ExitCode::kUsage, record.error().message);
  return *record;
}

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

std::vector<SweepPoint> sweep_quality(const StreamFile& file, std::vector<Camera> cameras,
                                      const BackendChoice& choice, const io::Progress& progress) {
  const int all_levels = file.header().tree_height + 1;
  const size_t points = size_t{3} * 2 * static_cast<size_t>(all_levels);
  std::vector<RealFrame> real;
  for (Camera& camera : cameras) {
    camera.filter = Filter::kQuadrilinear;
    record_of(camera, file.header());
    real.push_back(value_or_throw(render_real(file.decoder(), camera, 0), file.path()));
    progress(real.size(), cameras.size() + points);
  }
  std::vector<SweepPoint> sweep;
  for (const Filter filter : {Filter::kNearest, Filter::kBilinear, Filter::kQuadrilinear}) {
    for (int levels = 1; levels <= all_levels; ++levels) {
      for (const bool cached : {false, true}) {
        BackendChoice setting = choice;
        if (!cached) setting.options.cache_bytes = 0;
        const auto renderer = make_renderer(setting, file);
        SweepPoint point{filter, levels, cached, 0, 0};
        double squares = 0;
        Frame frame;
        for (size_t k = 0; k < cameras.size(); ++k) {
          cameras[k].filter = filter;
          const FrameRecord record = record_of(cameras[k], file.header());
          value_or_throw(renderer->render(record, file.stop_level(levels), frame), file.path());
          point.seconds += frame.seconds.total() / static_cast<double>(cameras.size());
          squares += mean_squared_error(frame.image, real[k]) / static_cast<double>(cameras.size());
        }
        const double peak = (1 << file.header().depth) - 1;
        point.psnr = squares > 0 ? 10 * std::log10(peak * peak / squares)
                                 : std::numeric_limits<double>::infinity();
        sweep.push_back(point);
        progress(cameras.size() + sweep.size(), cameras.size() + points);
      }
    }
  }
  return sweep;
}

}  // namespace hmlfc::cli
