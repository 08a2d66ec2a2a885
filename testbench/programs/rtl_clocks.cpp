// rtl-clocks: measures what blocks of each state take.
#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "systemc/clocks.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitDifferent = 1;
constexpr int kExitUsage = 2;

int run(int argc, char** argv) {
  CLI::App app{"Measures how many clocks the decode unit takes for blocks of each state"};
  bool json = false;
  bool header = false;
  app.add_flag("--json", json, "Print JSON");
  app.add_flag("--header", header, "Print tlm/latency_table.hpp, which the TLM model uses");
  CLI11_PARSE(app, argc, argv);
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, 2, 8);
  if (maker == nullptr) {
    fmt::print(stderr, "rtl-clocks: this build has no Verilated unit for blocks of 4\n");
    return kExitUsage;
  }
  Bench bench;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const ClockTable table = measure_clocks(bench, *maker, [&](const std::string& name) {
    if (terminal) fmt::print(stderr, "\r\033[K{}", name);
  });
  if (terminal) fmt::print(stderr, "\r\033[K");
  if (const auto& mismatch = bench.findings().first()) {
    fmt::print(stderr, "rtl-clocks: {}\n", to_string(*mismatch));
    return kExitDifferent;
  }
  fmt::print("{}", header ? to_header(table) : json ? to_json(table) : to_text(table));
  return 0;
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::run(argc, argv); }
