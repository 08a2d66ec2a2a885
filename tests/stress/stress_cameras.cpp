// stress_cameras [--seed S] [--count N] [--seconds T]: random and extreme cameras before small
// light fields; prints what they came to as JSON. Each camera gives a frame or a clear error; where
// it gives one, the frame in fixed point stays within the bound of ERR-1 (docs/rendering.md) of the
// frame in double precision. Exit status: 0 nothing wrong, 1 a finding, 2 wrong arguments.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>

#include <CLI/CLI.hpp>

#include "camera_case.hpp"
#include "vectors/json.hpp"

namespace hmlfc::stress {
namespace {

using vectors::Json;

struct Totals {
  uint64_t cameras = 0;
  uint64_t frames = 0;
  uint64_t samples_compared = 0;
  double worst_part = 0;  // of the bound
  Json worst;
  std::map<std::string, uint64_t> refused;  // by the input named
  Json findings = Json::array();
};

// The first word of an error says which input it is about.
std::string input_of(const std::string& message) {
  return message.substr(0, message.find_first_of(" '"));
}

void add(Totals& totals, const CameraCase& made, const CameraOutcome& outcome) {
  ++totals.cameras;
  if (!outcome.refused.empty()) ++totals.refused[input_of(outcome.refused)];
  totals.frames += outcome.refused.empty() ? 1u : 0u;
  totals.samples_compared += outcome.samples_compared;
  if (outcome.worst_part > totals.worst_part) {
    totals.worst_part = outcome.worst_part;
    totals.worst = describe(made);
  }
  if (!outcome.failure.empty()) {
    totals.findings.push_back({{"camera", describe(made)}, {"what", outcome.failure}});
  }
}

int run(int argc, char** argv) {
  uint64_t seed = 1;
  uint64_t count = 10000;
  double seconds = 1e9;
  double scale = 1;
  CLI::App app("Random and extreme cameras before small light fields.");
  app.add_option("--seed", seed);
  app.add_option("--count", count, "cameras at most");
  app.add_option("--seconds", seconds);
  app.add_option("--scale-bound", scale, "a fault to find: the bound is multiplied by this")
      ->check(CLI::Range(0.0, 1.0));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const auto begin = std::chrono::steady_clock::now();
  Totals totals;
  for (uint64_t n = 0; n < count; ++n) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    if (elapsed.count() >= seconds) break;
    const CameraCase made = camera_case(seed, n);
    add(totals, made, try_camera(made, scale));
    if (n % 200 == 0) {
      std::cerr << n << " cameras, " << totals.findings.size() << " findings" << std::endl;
    }
  }
  const Json report{{"cameras", totals.cameras},
                    {"frames", totals.frames},
                    {"refused", totals.refused},
                    {"samples_compared", totals.samples_compared},
                    {"worst_part_of_bound", totals.worst_part},
                    {"worst", totals.worst},
                    {"findings", totals.findings}};
  std::cout << report.dump(1) << '\n';
  return totals.findings.empty() ? 0 : 1;
}

}  // namespace
}  // namespace hmlfc::stress

int main(int argc, char** argv) {
  try {
    return hmlfc::stress::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "stress_cameras: " << error.what() << '\n';
    return 2;
  }
}
