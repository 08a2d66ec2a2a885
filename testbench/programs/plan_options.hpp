// What the commands that check blocks of a stream have in common: which blocks, in which order, and
// the report.
#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "stimulus/sequences.hpp"

namespace hmlfc::tb {

/// The requests of a run.
struct PlanOptions {
  std::string views = "1";
  std::string order = "scan";
  ScanPlan plan;  ///< complete once apply() has passed
  uint64_t mixed = 0;

  void add_to(CLI::App& app) {
    app.add_option("--views", views, "Number of views, drawn by the seed, or all")
        ->capture_default_str();
    app.add_option("--seed", plan.seed, "Seed of everything random")->capture_default_str();
    app.add_option("--order", order, "scan or random")
        ->check(CLI::IsMember({"scan", "random"}))
        ->capture_default_str();
    app.add_option("--plane", plan.plane, "0 Y, 1 Co, 2 Cg, 3 RGB")
        ->check(CLI::Range(0, 3))
        ->capture_default_str();
    app.add_option("--stop-level", plan.stop_level, "0 for views")->capture_default_str();
    app.add_option("--fraction", plan.fraction, "Share of the blocks, drawn by the seed")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    app.add_option("--mixed", mixed, "Number of random requests of all kinds, in place of views");
  }

  /// Takes views and order into the plan; false where views is neither a number nor all.
  bool apply() {
    plan.random_order = order == "random";
    if (views == "all") plan.views = ~uint64_t{0};
    return views == "all" || (CLI::detail::lexical_cast(views, plan.views) && plan.views != 0);
  }

  RequestSource requests(const Geometry& geometry, const StreamHeader& header) const {
    if (mixed != 0) return mixed_requests(geometry, header, mixed, plan.seed, 30);
    return scan_requests(geometry, header, plan);
  }

  /// The options that repeat the run.
  std::string replay() const {
    std::string text = fmt::format("--seed {}", plan.seed);
    if (mixed != 0) text += fmt::format(" --mixed {}", mixed);
    if (mixed == 0) text += fmt::format(" --views {} --order {}", views, order);
    if (plan.plane != kRgb) text += fmt::format(" --plane {}", plan.plane);
    if (plan.stop_level != 0) text += fmt::format(" --stop-level {}", plan.stop_level);
    if (plan.fraction < 1) text += fmt::format(" --fraction {}", plan.fraction);
    return text;
  }
};

/// Prints a report as JSON, or a line for each value; then the verdict of its member "passed".
inline void print_report(const nlohmann::ordered_json& report, bool as_json) {
  if (as_json) return fmt::print("{}\n", report.dump(2));
  const nlohmann::ordered_json values = report.flatten();
  for (const auto& [path, value] : values.items()) {
    const std::string text = value.is_string()         ? value.get<std::string>()
                             : value.is_number_float() ? fmt::format("{:.4f}", double{value})
                                                       : value.dump();
    if (!value.empty()) fmt::print("{:<40} {}\n", path.substr(1), text);
  }
  fmt::print("{}\n", report["passed"] ? "equal to the model" : "FAILED");
}

}  // namespace hmlfc::tb
