// Frames a second, decoded pixels a second and each kernel's time, on a GPU.
//
// Usage: ./run bench gpu [FILE.hmlfc...]; --help. Without a FILE: scene `knights`, encoded in both
// profiles.
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <hmlfc/encoder.hpp>

#include "common/measuring.hpp"
#include "gpu/gpu_speed.hpp"
#include "scenes/scene.hpp"

namespace {

using namespace hmlfc;
using bench::value_of;
using Json = nlohmann::ordered_json;

constexpr double kGoalGigapixels = 20;
constexpr const char* kStages[] = {"surface", "mark", "compact", "walk", "samples", "render"};

// Frames a second of a square frame: what the paper has and what is the goal.
struct Target {
  uint32_t side;
  int paper;
  int goal;
};
constexpr Target kTargets[] = {{512, 200, 10000}, {1024, 160, 5000}};

struct Options {
  std::vector<std::string> files;
  bench::GpuPlan plan;
  gpu::DeviceOptions device;
  bool json = false;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("FILE", o.files, "Streams (default: scene knights in both profiles)");
  app.add_option("--side", o.plan.sides, "Pixels of square frames; several are possible")
      ->check(CLI::Range(1u, static_cast<unsigned>(kMaxFrameSide)))
      ->capture_default_str();
  app.add_option("--frames", o.plan.frames, "Frames of the camera's path, at most")
      ->check(CLI::Range(1u, 100000u))
      ->capture_default_str();
  app.add_option("--seconds", o.plan.seconds, "Of each measurement")
      ->check(CLI::Range(0.01, 600.0))
      ->capture_default_str();
  app.add_option("--device", o.device.device, "Number or part of the name of a Vulkan device");
  app.add_flag("--json", o.json, "Print JSON");
}

Json measure_scene(gpu::Device& device, const bench::GpuPlan& plan) {
  scenes::SceneParams params;
  params.scene = scenes::Scene::kKnights;
  params.rows = params.cols = 5;
  params.width = params.height = 512;
  const LightField field = scenes::render_scene(params, 0);
  Json streams = Json::array();
  for (const Profile profile : {Profile::kExtended, Profile::kMain}) {
    EncodeParams coding;
    coding.profile = profile;
    const auto encoded = value_of(encode(field, coding));
    const char* name = profile == Profile::kMain ? "knights, main" : "knights, extended";
    streams.push_back(bench::measure_stream(device, name, encoded.bytes, plan));
  }
  return streams;
}

Json measure(const Options& o) {
  auto device = value_of(gpu::Device::open(o.device));
  const gpu::DeviceInfo& info = device.info();
  Json json{{"device", info.name}, {"kind", info.kind}, {"driver", info.driver}};
  if (info.kind == "CPU") {
    json["note"] = "This device is a CPU: its times say nothing about a GPU.";
  }
  for (const Target& target : kTargets) {
    json["targets"].push_back({{"side", target.side},
                               {"paper_frames_a_second", target.paper},
                               {"goal_frames_a_second", target.goal}});
  }
  json["goal_gigapixels_a_second"] = kGoalGigapixels;
  json["streams"] = o.files.empty() ? measure_scene(device, o.plan) : Json::array();
  for (const std::string& name : o.files) {
    const auto file = value_of(io::map_file(name));
    json["streams"].push_back(bench::measure_stream(device, name, file.bytes(), o.plan));
  }
  return json;
}

double number(const Json& json, const char* name) { return json[name].get<double>(); }

std::string size_of(const Json& path) {
  return fmt::format("{0}x{0}{1}", path["side"].get<uint32_t>(),
                     path["geometry"].get<bool>() ? ", geometry" : "");
}

void print_row(const Json& path, const char* held) {
  const Json& speed = path[held];
  fmt::print("| {:<19} | {:<6} | {:>8.1f} | {:>8.1f} |", size_of(path), held,
             number(speed, "frames_a_second"), number(speed, "frames_a_second_99"));
  double all = 0;
  for (const char* stage : kStages) {
    const bool known = speed["stage_ms"].contains(stage);
    const double ms = known ? number(speed["stage_ms"], stage) : 0;
    fmt::print(" {:>8} |", known ? fmt::format("{:.3f}", ms) : "");
    all += ms;
  }
  const auto frames = speed["frames"].get<uint64_t>();
  fmt::print(" {:>8.3f} | {:>8} | {:>8} |\n", all, speed["blocks_needed"].get<uint64_t>() / frames,
             speed["blocks_decoded"].get<uint64_t>() / frames);
}

void print_stream(const Json& stream) {
  const Json& decode = stream["decode"];
  fmt::print("\n{}\n\nDecoding {} views: {:.3f} Gpixel/s on the device, {:.3f} to the host.",
             stream["stream"].get<std::string>(), decode["views"].get<uint64_t>(),
             number(decode, "gigapixels_a_second"), number(decode, "gigapixels_a_second_to_host"));
  fmt::print(" ms a view:");
  for (const auto& [stage, ms] : decode["stage_ms"].items()) {
    fmt::print(" {} {:.3f}", stage, ms.get<double>());
  }
  fmt::print("\n\n| {:<19} | {:<6} | {:>8} | {:>8} |", "frame", "held", "frames/s", "99 %");
  for (const char* stage : kStages) fmt::print(" {:>8} |", stage);
  fmt::print(" {:>8} | {:>8} | {:>8} |\n", "ms", "needed", "decoded");
  fmt::print("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Json& path : stream["paths"]) {
    for (const char* held : {"cold", "moving", "warm"}) print_row(path, held);
  }
  fmt::print("\n| frame | views a pixel | us of CPU a frame | recorded |\n|---|--:|--:|--:|\n");
  for (const Json& path : stream["paths"]) {
    fmt::print("| {} | {:.2f} | {:.1f} | {:.1f} |\n", size_of(path), number(path, "views_a_pixel"),
               number(path, "host_us"), number(path, "recorded_host_us"));
  }
}

void print_tables(const Json& json) {
  fmt::print("{} ({}), driver {}\n{}", json["device"].get<std::string>(),
             json["kind"].get<std::string>(), json["driver"].get<std::string>(),
             json.value("note", ""));
  for (const Target& target : kTargets) {
    fmt::print("\n{0}x{0}: paper {1}, goal {2} frames/s", target.side, target.paper, target.goal);
  }
  fmt::print("\nDecoding: goal {} Gpixel/s\n", kGoalGigapixels);
  for (const Json& stream : json["streams"]) print_stream(stream);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures a GPU with frames and whole views"};
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  return bench::run_program("bench_gpu", [&] {
    const Json json = measure(options);
    if (options.json) {
      fmt::print("{}\n", json.dump(2));
    } else {
      print_tables(json);
    }
  });
}
