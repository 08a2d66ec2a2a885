#include "gpu/speed.hpp"

#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "stage_times.hpp"

namespace hmlfc::gpu {
namespace {

using Clock = std::chrono::steady_clock;

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

double milliseconds_a_view(double seconds, const SpeedReport& report) {
  return 1000 * ratio(seconds, static_cast<double>(report.views));
}

double blocks_a_second(const SpeedReport& report, double seconds) {
  return ratio(static_cast<double>(report.blocks), seconds);
}

}  // namespace

Outcome<SpeedReport> measure_speed(GpuDecoder& decoder, const Device& device,
                                   const StreamView& stream, uint64_t views) {
  const PlaneShape& luma = stream.geometry.plane(Plane::kY);
  const uint64_t grid = uint64_t{stream.header.rows} * stream.header.cols;
  SpeedReport report;
  report.device = device.info().name;
  for (uint64_t i = 0; i <= views; ++i) {
    const uint64_t view = (i * grid / (views + 1)) % grid;
    const ViewPos at{static_cast<uint32_t>(view / stream.header.cols),
                     static_cast<uint32_t>(view % stream.header.cols)};
    const PixelArea area{at, 0, 0, luma.blocks_x, luma.blocks_y, 0};
    const auto begin = Clock::now();
    const auto pixels = decoder.decode_rgb(std::span(&area, 1));
    if (!pixels) return tl::unexpected(pixels.error());
    if (i == 0) continue;  // makes pipelines and buffers
    report.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    ++report.views;
    report.blocks += uint64_t{luma.blocks_x} * luma.blocks_y;
    add_times(decoder.stage_times(), report.stages);
  }
  return report;
}

double device_seconds(const std::vector<StageTime>& stages) {
  double seconds = 0;
  for (const StageTime& stage : stages) seconds += stage.seconds;
  return seconds;
}

std::string stage_text(const std::vector<StageTime>& stages, uint64_t count, const char* piece) {
  std::string text;
  for (const StageTime& stage : stages) {
    text += fmt::format("  {:<10} {:10.3f} ms a {}\n", stage.stage,
                        1000 * ratio(stage.seconds, static_cast<double>(count)), piece);
  }
  return text;
}

std::string to_text(const SpeedReport& report) {
  std::string text = fmt::format("{}: {} views of {} blocks\n", report.device, report.views,
                                 report.views == 0 ? 0 : report.blocks / report.views);
  text += stage_text(report.stages, report.views, "view");
  const auto add_line = [&](const char* what, double seconds) {
    text += fmt::format("  {:<10} {:10.3f} ms a view, {:.0f} blocks/s\n", what,
                        milliseconds_a_view(seconds, report), blocks_a_second(report, seconds));
  };
  if (!report.stages.empty()) add_line("device", device_seconds(report.stages));
  add_line("call", report.seconds);
  return text;
}

std::string to_json(const SpeedReport& report) {
  nlohmann::ordered_json json{{"device", report.device},
                              {"views", report.views},
                              {"blocks", report.blocks},
                              {"call_ms", milliseconds_a_view(report.seconds, report)},
                              {"call_blocks_per_second", blocks_a_second(report, report.seconds)}};
  for (const StageTime& stage : report.stages) {
    json["stage_ms"][stage.stage] = milliseconds_a_view(stage.seconds, report);
  }
  return json.dump(2) + "\n";
}

}  // namespace hmlfc::gpu
