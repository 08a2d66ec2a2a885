#include "gpu/gpu_report.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hmlfc::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kGoalGigapixels = 20;
constexpr std::string_view kStages[] = {"surface", "mark", "compact", "walk", "samples", "render"};

// Frames a second of a square frame: what the paper has and what is the goal.
struct Target {
  uint32_t side;
  int paper;
  int goal;
};
constexpr Target kTargets[] = {{512, 200, 10000}, {1024, 160, 5000}};

// Empty where times mean something.
std::string_view note_of(const gpu::DeviceInfo& device) {
  return device.kind == "CPU" ? "This device is a CPU: its times say nothing about a GPU." : "";
}

double milliseconds(double seconds, uint64_t pieces) {
  return 1000 * seconds / static_cast<double>(std::max<uint64_t>(pieces, 1));
}

double gigapixels(const DecodeSpeed& speed, double seconds) {
  return seconds > 0 ? 1e-9 * static_cast<double>(speed.pixels) / seconds : 0;
}

double microseconds_of_host(const gpu::HostCost& cost) {
  return 1000 * milliseconds(cost.cpu_seconds, cost.frames);
}

// Milliseconds of the stage `name` a frame, or nothing.
std::string stage_text(const FrameSpeed& speed, std::string_view name) {
  const auto found = std::ranges::find(speed.stages, name, &gpu::StageTime::stage);
  if (found == speed.stages.end()) return "";
  return fmt::format("{:.3f}", milliseconds(found->seconds, speed.frames));
}

std::string row(const PathSpeed& path, const FrameSpeed& speed) {
  const std::string size = fmt::format("{0}x{0}{1}", path.side, path.geometry ? ", geometry" : "");
  std::string text = fmt::format("| {:<19} | {:<6} | {:>8.1f} | {:>8.1f} |", size, speed.held,
                                 speed.frames_a_second, speed.slow_frames_a_second);
  for (const std::string_view stage : kStages) {
    text += fmt::format(" {:>8} |", stage_text(speed, stage));
  }
  return text + fmt::format(" {:>8.3f} | {:>8} | {:>8} |\n",
                            milliseconds(device_seconds(speed.stages), speed.frames),
                            speed.needed / speed.frames, speed.decoded / speed.frames);
}

std::string to_text(const StreamSpeed& stream) {
  const DecodeSpeed& decode = stream.decode;
  std::string text =
      fmt::format("\n{}\n\nDecoding {} views: {:.3f} Gpixel/s on the device, {:.3f} to the host.",
                  stream.name, decode.views, gigapixels(decode, device_seconds(decode.stages)),
                  gigapixels(decode, decode.seconds));
  text += " ms a view:";
  for (const auto& stage : decode.stages) {
    text += fmt::format(" {} {:.3f}", stage.stage, milliseconds(stage.seconds, decode.views));
  }
  text +=
      fmt::format("\n\n| {:<19} | {:<6} | {:>8} | {:>8} |", "frame", "held", "frames/s", "99 %");
  for (const std::string_view stage : kStages) text += fmt::format(" {:>8} |", stage);
  text += fmt::format(" {:>8} | {:>8} | {:>8} |\n", "ms", "needed", "decoded");
  text += "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const PathSpeed& path : stream.paths) {
    for (const FrameSpeed& speed : path.speeds) text += row(path, speed);
  }
  text += "\n| frame | views a pixel | us of CPU a frame | recorded |\n|---|--:|--:|--:|\n";
  for (const PathSpeed& path : stream.paths) {
    text += fmt::format("| {0}x{0}{1} | {2:.2f} | {3:.1f} | {4:.1f} |\n", path.side,
                        path.geometry ? ", geometry" : "", path.views,
                        microseconds_of_host(path.begun), microseconds_of_host(path.recorded));
  }
  return text;
}

Json stages_json(std::span<const gpu::StageTime> stages, uint64_t pieces) {
  Json json = Json::object();
  for (const auto& stage : stages) json[stage.stage] = milliseconds(stage.seconds, pieces);
  return json;
}

Json json_of(const PathSpeed& path) {
  Json json{{"side", path.side},
            {"geometry", path.geometry},
            {"views_a_pixel", path.views},
            {"host_us", microseconds_of_host(path.begun)},
            {"recorded_host_us", microseconds_of_host(path.recorded)}};
  for (const FrameSpeed& speed : path.speeds) {
    json[speed.held] = {{"frames", speed.frames},
                        {"frames_a_second", speed.frames_a_second},
                        {"frames_a_second_99", speed.slow_frames_a_second},
                        {"stage_ms", stages_json(speed.stages, speed.frames)},
                        {"blocks_needed", speed.needed},
                        {"blocks_decoded", speed.decoded}};
  }
  return json;
}

Json json_of(const StreamSpeed& stream) {
  const DecodeSpeed& decode = stream.decode;
  Json json{{"stream", stream.name},
            {"decode",
             {{"views", decode.views},
              {"gigapixels_a_second", gigapixels(decode, device_seconds(decode.stages))},
              {"gigapixels_a_second_to_host", gigapixels(decode, decode.seconds)},
              {"stage_ms", stages_json(decode.stages, decode.views)}}}};
  for (const PathSpeed& path : stream.paths) json["paths"].push_back(json_of(path));
  return json;
}

}  // namespace

std::string to_text(const gpu::DeviceInfo& device, std::span<const StreamSpeed> streams) {
  std::string text = fmt::format("{} ({}), driver {}\n{}", device.name, device.kind, device.driver,
                                 note_of(device));
  for (const Target& target : kTargets) {
    text += fmt::format("\n{0}x{0}: paper {1}, goal {2} frames/s", target.side, target.paper,
                        target.goal);
  }
  text += fmt::format("\nDecoding: goal {} Gpixel/s\n", kGoalGigapixels);
  for (const StreamSpeed& stream : streams) text += to_text(stream);
  return text;
}

std::string to_json(const gpu::DeviceInfo& device, std::span<const StreamSpeed> streams) {
  Json json{{"device", device.name}, {"kind", device.kind}, {"driver", device.driver}};
  if (!note_of(device).empty()) json["note"] = note_of(device);
  for (const Target& target : kTargets) {
    json["targets"].push_back({{"side", target.side},
                               {"paper_frames_a_second", target.paper},
                               {"goal_frames_a_second", target.goal}});
  }
  json["goal_gigapixels_a_second"] = kGoalGigapixels;
  for (const StreamSpeed& stream : streams) json["streams"].push_back(json_of(stream));
  return json.dump(2) + "\n";
}

}  // namespace hmlfc::bench
