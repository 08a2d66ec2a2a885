// Which blocks of a stream a command checks, and in which order.
#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "programs/commands.hpp"
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
    app.add_option("--mixed", mixed, "Number of random requests of all kinds, instead of views");
  }

  /// Takes views and order into the plan. Throws Stop where views is neither a number nor all.
  void apply() {
    plan.random_order = order == "random";
    if (views == "all") {
      plan.views = ~uint64_t{0};
    } else if (!CLI::detail::lexical_cast(views, plan.views) || plan.views == 0) {
      throw Stop{"--views is a number or all"};
    }
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

}  // namespace hmlfc::tb
