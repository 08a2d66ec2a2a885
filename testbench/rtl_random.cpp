// rtl-random: the regression. Random streams of both profiles, intact and damaged, with random
// sequences and conditions, all by seed.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "failure_folder.hpp"
#include "stand_in.hpp"
#include "suite.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitDifferent = 1;
constexpr int kExitUsage = 2;

struct Options {
  uint32_t seed = 0;
  uint32_t count = 1;
  double minutes = 0;
  std::string unit = "rtl";
  std::string output = "out";
  bool coverage = false;
  std::string points;
};

std::string replay_command(const Options& o, uint32_t seed, uint32_t count) {
  std::string text = fmt::format("./run rtl-random --seed {} --count {}", seed, count);
  if (o.unit != "rtl") text += " --unit " + o.unit;
  return text;
}

std::vector<UnitMaker> makers_of(const Options& o) {
  if (o.unit == "rtl") return rtl_units();
  return {{"stand-in", {2, 12, 16, 16}, &StandIn::make},
          {"stand-in", {1, 12, 8, 16}, &StandIn::make},
          {"stand-in", {3, 12, 16, 16}, &StandIn::make}};
}

// One seed on one unit; whether all was equal.
bool run_seed(Bench& bench, const UnitMaker& maker, const Options& o, uint32_t seed,
              ScoreCounts& total) {
  auto bytes = suite_stream(seed, maker.parameters.block_size());
  spoil(bytes, suite_damage(seed), seed);
  StreamImage image(bytes, maker.parameters);
  const SuiteResult result = run_case(bench, maker, image, seed);
  total += result.counts;
  if (!result.mismatch) return true;
  const std::string replay = replay_command(o, seed, 1);
  const std::string id = fmt::format("random-{}-block-{}", seed, maker.parameters.block_size());
  const auto folder =
      keep_failure(bench, maker, image, {*result.mismatch, result.history, replay, id}, o.output);
  std::ofstream(folder / "stream.hmlfc", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  fmt::print("MISMATCH: seed {}, block size {}: {}\nkept in {}\nreplay: {}\n", seed,
             maker.parameters.block_size(), to_string(*result.mismatch), folder.string(), replay);
  return false;
}

void print_replay(const Options& o, uint32_t count) {
  fmt::print(stderr, "seed {}, replay: {}\n", o.seed, replay_command(o, o.seed, count));
}

// When to stop; a terminal sees how far it is.
class Progress {
 public:
  explicit Progress(const Options& o) : options_(o) {}

  // Whether `seed` is still to be run; a seed that has begun is run to its end.
  bool goes_on(uint32_t seed) const {
    const uint32_t done = seed - options_.seed;
    const bool more = options_.minutes == 0 ? done < options_.count : minutes() < options_.minutes;
    if (more && terminal_) fmt::print(stderr, "\rseed {}, {:.1f} minutes", seed, minutes());
    return more;
  }

  void clear() const {
    if (terminal_) fmt::print(stderr, "\r\033[K");
  }

 private:
  using Clock = std::chrono::steady_clock;

  double minutes() const {
    return std::chrono::duration<double, std::ratio<60>>(Clock::now() - begin_).count();
  }

  const Options& options_;
  Clock::time_point begin_ = Clock::now();
  bool terminal_ = isatty(STDERR_FILENO) != 0;
};

int run(int argc, char** argv) {
  CLI::App app{"Checks the decode unit on random streams"};
  Options o;
  app.add_option("--seed", o.seed, "Of the first stream")->capture_default_str();
  app.add_option("--count", o.count, "How many seeds from there")->capture_default_str();
  app.add_option("--minutes", o.minutes, "Go on for so long instead of --count seeds")
      ->check(CLI::Range(0.0, 100000.0));
  app.add_option("--unit", o.unit, "rtl or stand-in")
      ->check(CLI::IsMember({"rtl", "stand-in"}))
      ->capture_default_str();
  app.add_option("--output", o.output, "Folder that failure/ID/ is put into")
      ->capture_default_str();
  app.add_flag("--coverage", o.coverage, "Print the functional coverage");
  app.add_option("--points", o.points, "Write the functional coverage to this file, as JSON");
  CLI11_PARSE(app, argc, argv);
  const auto makers = makers_of(o);
  if (makers.empty()) {
    fmt::print(stderr, "rtl-random: this build has no Verilated unit (Verilator is missing)\n");
    return kExitUsage;
  }
  if (o.minutes == 0) print_replay(o, o.count);
  Bench bench;
  ScoreCounts total;
  uint32_t failed = 0;
  Progress progress(o);
  uint32_t seed = o.seed;
  for (; progress.goes_on(seed) && failed == 0; ++seed) {
    for (const UnitMaker& maker : makers) failed += !run_seed(bench, maker, o, seed, total);
  }
  progress.clear();
  const bool agree = total.sent == total.received + total.dropped &&
                     total.received == total.compared + total.unchecked;
  fmt::print("{} streams on {} units each, seeds {} to {}\n", seed - o.seed, makers.size(), o.seed,
             seed - 1);
  fmt::print("{} sent, {} received, {} compared, {} unchecked, {} dropped, {} stage records\n",
             total.sent, total.received, total.compared, total.unchecked, total.dropped,
             total.records);
  if (o.coverage) fmt::print("{}", bench.coverage().report());
  if (!o.points.empty()) std::ofstream(o.points) << bench.coverage().to_json();
  fmt::print("{}\n", failed == 0 && agree ? "equal to the model" : "FAILED");
  std::fflush(stdout);
  print_replay(o, seed - o.seed);
  return failed == 0 && agree ? 0 : kExitDifferent;
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::run(argc, argv); }
