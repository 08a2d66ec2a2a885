#include "cli/render_backend.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/camera_options.hpp"
#include "cli/output.hpp"
#include "gpu_ref/render/gpu_frame_renderer.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {

namespace {

template <class T>
T device_value(gpu::Outcome<T> outcome) {
  if (!outcome) throw Failure(ExitCode::kUsage, "--backend gpu: " + outcome.error().message);
  return std::move(*outcome);
}

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
    std::unique_ptr<FrameRenderer> renderer;
    file.with_bytes({0, file.size()}, [&](std::span<const uint8_t>) {
      renderer = device_value(gpu::make_gpu_renderer(device_value(gpu::Device::open(options)),
                                                     file.decoder(), choice.options));
    });
    return renderer;
  }
  if (!choice.device.empty()) throw Failure(ExitCode::kUsage, "--device needs --backend gpu");
  return make_cpu_renderer(file.decoder(), choice.options);
}

namespace {

// One setting, over all frames of a path.
struct SweepPoint {
  Filter filter = Filter::kQuadrilinear;
  int levels = 1;       // of the tree, from the top
  bool cached = false;  // blocks are kept between frames
  double seconds = 0;   // per frame, wall clock
  double psnr = 0;      // over RGB, dB
};

std::vector<SweepPoint> sweep_quality(const StreamFile& file, std::vector<Camera> cameras,
                                      const BackendChoice& choice,
                                      terminal::ProgressBar& progress) {
  const int all_levels = file.header().tree_height + 1;
  const size_t points = size_t{3} * 2 * static_cast<size_t>(all_levels);
  std::vector<RealFrame> real;
  for (Camera& camera : cameras) {
    camera.filter = Filter::kQuadrilinear;
    record_of(camera, file.header());
    real.push_back(file.value(render_real(file.decoder(), camera, 0)));
    progress.update(real.size(), cameras.size() + points);
  }
  std::vector<SweepPoint> sweep;
  for (const Filter filter : {Filter::kNearest, Filter::kViews, Filter::kQuadrilinear}) {
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
          file.value(renderer->render(record, file.stop_level(levels), frame));
          point.seconds += frame.seconds.total() / static_cast<double>(cameras.size());
          squares += mean_squared_error(frame.image, real[k]) / static_cast<double>(cameras.size());
        }
        const double peak = (1 << file.header().depth) - 1;
        point.psnr = squares > 0 ? 10 * std::log10(peak * peak / squares)
                                 : std::numeric_limits<double>::infinity();
        sweep.push_back(point);
        progress.update(cameras.size() + sweep.size(), cameras.size() + points);
      }
    }
  }
  return sweep;
}

}  // namespace

void print_quality_sweep(const StreamFile& file, std::vector<Camera> cameras,
                         const BackendChoice& choice, bool json) {
  terminal::ProgressBar progress("Rendering", "settings");
  const auto points = sweep_quality(file, std::move(cameras), choice, progress);
  progress.clear();
  Json rows = Json::array();
  std::string text =
      "PSNR against frames computed in real numbers with filter quadrilinear and all levels\n\n"
      "| filter | levels | cache | ms per frame | PSNR RGB |\n|---|---|---|---|---|\n";
  for (const SweepPoint& point : points) {
    rows.push_back({{"filter", filter_name(point.filter)},
                    {"levels", point.levels},
                    {"cache", point.cached},
                    {"seconds", point.seconds},
                    {"psnr_rgb", psnr_json(point.psnr)}});
    text += fmt::format("| {} | {} | {} | {:.2f} | {} |\n", filter_name(point.filter), point.levels,
                        point.cached ? "yes" : "no", point.seconds * 1e3, psnr_text(point.psnr));
  }
  print_result(json, rows, text);
}

}  // namespace hmlfc::cli
