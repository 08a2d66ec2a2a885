// stress_cameras [--seed S] [--count N] [--seconds T]: frames at the ends of what the clauses
// allow, then random and extreme cameras before small light fields; prints the results as JSON.
// Each camera must give a frame or an error, and each quantity of docs/rendering.md, section 6,
// must stay within its interval. Exit status: 0 no findings, 1 a finding, 2 wrong arguments.
#include <chrono>

#include <CLI/CLI.hpp>

#include "camera_case.hpp"
#include "program.hpp"
#include "width_record.hpp"

namespace hmlfc::stress {
namespace {

using vectors::Json;

constexpr uint64_t kWholeViews = 40;  // of random streams: samples at both ends, at all depths

struct Arguments {
  uint64_t seed = 1;
  uint64_t count = 10000;
  double seconds = 1e9;
};

struct Totals {
  uint64_t cameras = 0;
  uint64_t frames = 0;
  Json findings = Json::array();
  WidthReport widths{WidthTable::kFrames};
};

// Adds what was watched since the last call; `camera` is named if a value left its interval.
void add_widths(Totals& totals, const std::string& name, const Json& camera) {
  totals.widths.add(name, take_ranges());
  if (const auto violation = take_violation()) {
    totals.findings.push_back({{"camera", camera}, {"what", *violation}});
  }
}

void add_camera(Totals& totals, const std::string& name, const CameraCase& made) {
  const CameraOutcome outcome = try_camera(made);
  ++totals.cameras;
  totals.frames += outcome.refused ? 0u : 1u;
  if (!outcome.failure.empty()) {
    totals.findings.push_back({{"camera", describe(made)}, {"what", outcome.failure}});
  }
  add_widths(totals, name, describe(made));
}

Json run(const Arguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  Totals totals;
  run_frame_extremes([&](const std::string& name) { add_widths(totals, name, name); });
  for (uint64_t n = 0; n < kWholeViews; ++n) {
    add_camera(totals, "view of random stream " + std::to_string(n), view_case(n));
  }
  for (uint64_t n = 0; n < arguments.count; ++n) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    if (elapsed.count() >= arguments.seconds) break;
    const std::string name =
        "camera " + std::to_string(n) + " of seed " + std::to_string(arguments.seed);
    add_camera(totals, name, camera_case(arguments.seed, n));
  }
  return {{"cameras", totals.cameras},
          {"frames", totals.frames},
          {"findings", totals.findings},
          {"rows", totals.widths.rows()}};
}

}  // namespace
}  // namespace hmlfc::stress

int main(int argc, char** argv) {
  hmlfc::stress::Arguments arguments;
  CLI::App app("Frames at the ends of what the clauses allow; random and extreme cameras.",
               "stress_cameras");
  app.add_option("--seed", arguments.seed);
  app.add_option("--count", arguments.count, "most random cameras");
  app.add_option("--seconds", arguments.seconds);
  return hmlfc::stress::run_program(app, argc, argv, [&] { return hmlfc::stress::run(arguments); });
}
