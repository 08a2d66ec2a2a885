// stress_cameras [--seed S] [--count N] [--seconds T]: frames at the ends of what the clauses
// allow, then random and extreme cameras before small light fields; prints the results as JSON.
// Each camera must give a frame or an error that names the input. A frame in fixed point must stay
// within the bound of ERR-1, or SRF-6 (docs/rendering.md), of the frame in double precision, and
// each quantity of section 6 within its interval. Exit status: 0 no findings, 1 a finding, 2 wrong
// arguments.
#include <chrono>
#include <map>

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
  uint64_t displaced = 0;
  uint64_t samples_compared = 0;
  double worst_part = 0;  // of the bound
  Json worst;
  std::map<std::string, uint64_t> refused;  // by input
  Json findings = Json::array();
  WidthReport widths{WidthTable::kFrames};
};

// The first word of an error names the input.
std::string input_of(const std::string& message) {
  return message.substr(0, message.find_first_of(" '"));
}

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
  if (!outcome.refused.empty()) ++totals.refused[input_of(outcome.refused)];
  totals.frames += outcome.refused.empty() ? 1u : 0u;
  totals.displaced += outcome.displaced ? 1u : 0u;
  totals.samples_compared += outcome.samples_compared;
  if (outcome.worst_part > totals.worst_part) {
    totals.worst_part = outcome.worst_part;
    totals.worst = describe(made);
  }
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
          {"refused", totals.refused},
          {"displaced", totals.displaced},
          {"samples_compared", totals.samples_compared},
          {"worst_part_of_bound", totals.worst_part},
          {"worst", totals.worst},
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
