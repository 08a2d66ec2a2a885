// Frames a second, decoded pixels a second and each kernel's time, on a GPU.
//
// Usage: ./run bench gpu [FILE.hmlfc...]; --help. Without a FILE: scene `knights`, encoded in both
// profiles.
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <hmlfc/encoder.hpp>

#include "common/program.hpp"
#include "gpu/gpu_report.hpp"
#include "gpu/gpu_speed.hpp"
#include "io/files.hpp"
#include "scenes/scene.hpp"

namespace {

using namespace hmlfc;
using bench::value_of;

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

std::vector<bench::StreamSpeed> measure_scene(gpu::Device& device, const bench::GpuPlan& plan) {
  scenes::SceneParams params;
  params.scene = scenes::Scene::kKnights;
  params.rows = params.cols = 5;
  params.width = params.height = 512;
  const LightField field = scenes::render_scene(params, 0);
  std::vector<bench::StreamSpeed> speeds;
  for (const Profile profile : {Profile::kExtended, Profile::kMain}) {
    EncodeParams coding;
    coding.profile = profile;
    const auto encoded = value_of(encode(field, coding));
    const char* name = profile == Profile::kMain ? "knights, main" : "knights, extended";
    speeds.push_back(bench::measure_stream(device, name, encoded.bytes, plan));
  }
  return speeds;
}

int run(const Options& o) {
  auto device = value_of(gpu::Device::open(o.device));
  std::vector<bench::StreamSpeed> speeds;
  if (o.files.empty()) speeds = measure_scene(device, o.plan);
  for (const std::string& name : o.files) {
    const auto file = value_of(io::map_file(name));
    speeds.push_back(bench::measure_stream(device, name, file.bytes(), o.plan));
  }
  fmt::print("{}", o.json ? to_json(device.info(), speeds) : to_text(device.info(), speeds));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures a GPU with frames and whole views"};
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  return bench::run_program("bench_gpu", [&] { return run(options); });
}
