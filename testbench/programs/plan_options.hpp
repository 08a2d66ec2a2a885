// The options of the commands that check blocks of a stream: which blocks, in which order.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "stimulus/sequences.hpp"

namespace hmlfc::tb {

/// Adds --views, --seed, --order, --plane, --stop-level, --fraction and --mixed.
inline void add_plan_options(CLI::App& app, std::string& views, std::string& order, ScanPlan& plan,
                             uint64_t& mixed) {
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

}  // namespace hmlfc::tb
