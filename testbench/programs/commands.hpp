// What the commands of the test bench have in common.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "io/files.hpp"

namespace hmlfc::tb {

inline constexpr int kExitDifferent = 1;  // something is not equal to the model
inline constexpr int kExitUsage = 2;

/// Ends a command with a message.
struct Stop {
  std::string message;
  int exit_code = kExitUsage;
};

/// What a command does once its options are read; its exit status. Throws Stop.
using Command = std::function<int()>;

// Each adds the options of a command to `app`.
Command add_bench(CLI::App& app);
Command add_check(CLI::App& app);
Command add_clocks(CLI::App& app);
Command add_crosscheck(CLI::App& app);
Command add_decode(CLI::App& app);
Command add_random(CLI::App& app);
Command add_view(CLI::App& app);

/// The bytes of a file. Throws Stop.
inline MappedFile read_file(const std::string& path) {
  auto file = io::map_file(path);
  if (!file) throw Stop{file.error().message};
  return std::move(*file);
}

/// Runs `command`; how to repeat it is said before and after.
inline int with_replay(uint64_t seed, const std::string& replay, const Command& command) {
  const std::string head = fmt::format("seed {}, replay: {}\n", seed, replay);
  fmt::print(stderr, "{}", head);
  const int status = command();
  std::fflush(stdout);
  fmt::print(stderr, "{}", head);
  return status;
}

/// Prints a report as JSON, or a line for each value; then the verdict of its member "passed". The
/// exit status.
inline int print_report(const nlohmann::ordered_json& report, bool as_json) {
  const bool passed = report["passed"];
  if (as_json) {
    fmt::print("{}\n", report.dump(2));
  } else {
    const nlohmann::ordered_json values = report.flatten();
    for (const auto& [path, value] : values.items()) {
      const std::string text = value.is_string()         ? value.get<std::string>()
                               : value.is_number_float() ? fmt::format("{:.4f}", double{value})
                                                         : value.dump();
      if (!value.empty()) fmt::print("{:<40} {}\n", path.substr(1), text);
    }
    fmt::print("{}\n", passed ? "equal to the model" : "FAILED");
  }
  return passed ? 0 : kExitDifferent;
}

}  // namespace hmlfc::tb
