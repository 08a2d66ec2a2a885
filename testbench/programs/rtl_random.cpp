// random: the regression. Random streams of both profiles, intact and damaged, or the
// conformance vectors, with random sequences and conditions, all by seed.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "programs/commands.hpp"
#include "syntax/header.hpp"
#include "systemc/failure_folder.hpp"
#include "systemc/suite.hpp"
#include "terminal/clock.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::tb {
namespace {

struct Options {
  uint32_t seed = 0;
  uint32_t count = 1;
  double minutes = 0;
  std::string output = "out";
  bool coverage = false;
  bool all_points = false;
  std::string points;
  std::string suite;
};

// A stream for the units that are to decode it.
struct Case {
  uint32_t seed = 0;
  std::string name;
  std::vector<uint8_t> bytes;
};

std::string replay_command(const Options& o, uint32_t seed, uint32_t count) {
  std::string text = fmt::format("./run rtl-random --seed {} --count {}", seed, count);
  if (!o.suite.empty()) text += " --suite " + o.suite;
  return text;
}

// One stream on one unit; whether all was equal.
bool run_stream(Bench& bench, const UnitMaker& maker, const Options& o, const Case& one,
                ScoreCounts& total) {
  StreamImage image(one.bytes, maker.parameters);
  const SuiteResult result = run_case(bench, maker, image, one.seed);
  total += result.counts;
  if (!result.mismatch) return true;
  const std::string replay = replay_command(o, one.seed, 1);
  const std::string id = fmt::format("random-{}-block-{}", one.seed, maker.parameters.block_size());
  const auto folder =
      keep_failure(bench, maker, image, {*result.mismatch, result.history, replay, id}, o.output);
  std::ofstream(folder / "stream.hmlfc", std::ios::binary)
      .write(reinterpret_cast<const char*>(one.bytes.data()),
             static_cast<std::streamsize>(one.bytes.size()));
  fmt::print("MISMATCH: {}, block size {}: {}\nkept in {}\nreplay: {}\n", one.name,
             maker.parameters.block_size(), to_string(*result.mismatch), folder.string(), replay);
  return false;
}

// A random stream of each unit's block size.
bool run_seed(Bench& bench, const std::vector<UnitMaker>& makers, const Options& o, uint32_t seed,
              ScoreCounts& total) {
  bool equal = true;
  for (const UnitMaker& maker : makers) {
    Case one{seed, fmt::format("seed {}", seed), suite_stream(seed, maker.parameters.block_size())};
    corrupt(one.bytes, suite_damage(seed), seed);
    equal = run_stream(bench, maker, o, one, total) && equal;
  }
  return equal;
}

std::vector<vectors::Vector> vectors_of(const Options& o) {
  if (o.suite.empty()) return {};
  auto manifest = vectors::read_manifest(o.suite);
  if (!manifest) throw Stop{manifest.error().message};
  return std::move(manifest->vectors);
}

// A vector on the unit for its block size; without a sound header on the first.
bool run_vector(Bench& bench, const std::vector<UnitMaker>& makers, const Options& o,
                const vectors::Vector& vector, uint32_t seed, ScoreCounts& total) {
  const MappedFile file = read_file(std::filesystem::path(o.suite) / vector.input.file);
  const auto header = parse_header(file.bytes());
  const UnitMaker* maker =
      header ? unit_for(makers, header->block_log2, header->depth) : &makers.front();
  const Case one{seed, vector.id.text(), {file.bytes().begin(), file.bytes().end()}};
  return maker == nullptr || run_stream(bench, *maker, o, one, total);
}

void print_replay(const Options& o, uint32_t count) {
  fmt::print(stderr, "seed {}, replay: {}\n", o.seed, replay_command(o, o.seed, count));
}

// Whether `seed` is still to be run; a seed that has begun is run to its end. A terminal sees it.
bool goes_on(const Options& o, uint32_t seed, const Clock& clock) {
  const double minutes = clock.wall_seconds() / 60;
  const bool more = o.minutes == 0 ? seed - o.seed < o.count : minutes < o.minutes;
  if (isatty(STDERR_FILENO) != 0) {
    fmt::print(stderr, "\r\033[K");
    if (more) fmt::print(stderr, "seed {}, {:.1f} minutes", seed, minutes);
  }
  return more;
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("--seed", o.seed, "Seed of the first stream")->capture_default_str();
  app.add_option("--count", o.count, "Number of seeds")->capture_default_str();
  app.add_option("--minutes", o.minutes, "Run for this time instead of --count seeds")
      ->check(CLI::Range(0.0, 100000.0));
  app.add_option("--output", o.output, "Folder in which failure/ID/ is created")
      ->capture_default_str();
  app.add_option(
      "--suite", o.suite,
      "Run the vectors of this folder instead of random streams; a seed is a vector's number");
  app.add_flag("--coverage", o.coverage, "Print the functional coverage");
  app.add_flag("--all-points", o.all_points, "Fail where a functional point is not met");
  app.add_option("--points", o.points, "Write the functional coverage to this file, as JSON");
}

int run(Options& o) {
  const auto makers = rtl_units();
  if (makers.empty()) throw Stop{"this build has no Verilated unit (Verilator is missing)"};
  const std::vector<vectors::Vector> suite = vectors_of(o);
  if (!o.suite.empty()) {
    if (o.seed >= suite.size()) throw Stop{o.suite + " has no vector of that number"};
    o.minutes = 0;
    o.count = std::min(o.count, static_cast<uint32_t>(suite.size()) - o.seed);
  }
  if (o.minutes == 0) print_replay(o, o.count);
  Bench bench;
  ScoreCounts total;
  uint32_t failed = 0;
  const Clock clock;
  uint32_t seed = o.seed;
  for (; failed == 0 && goes_on(o, seed, clock); ++seed) {
    failed += suite.empty() ? !run_seed(bench, makers, o, seed, total)
                            : !run_vector(bench, makers, o, suite[seed], seed, total);
  }
  const bool agree = total.sent == total.received + total.dropped &&
                     total.received == total.compared + total.unchecked;
  fmt::print("{} streams on {}, seeds {} to {}\n", seed - o.seed,
             suite.empty() ? fmt::format("{} units each", makers.size()) : "the unit for each",
             o.seed, seed - 1);
  fmt::print("{} sent, {} received, {} compared, {} unchecked, {} dropped, {} stage records\n",
             total.sent, total.received, total.compared, total.unchecked, total.dropped,
             total.records);
  if (o.coverage) fmt::print("{}", bench.coverage().report());
  if (!o.points.empty()) std::ofstream(o.points) << bench.coverage().to_json();
  fmt::print("{}\n", failed == 0 && agree ? "equal to the model" : "FAILED");
  const std::vector<std::string> missed = bench.coverage().missed();
  if (o.all_points && !missed.empty()) fmt::print("not met: {}\n", fmt::join(missed, ", "));
  std::fflush(stdout);
  print_replay(o, seed - o.seed);
  const bool met = !o.all_points || missed.empty();
  return failed == 0 && agree && met ? 0 : kExitDifferent;
}

}  // namespace

Command add_random(CLI::App& app) {
  auto options = std::make_shared<Options>();
  add_options(app, *options);
  return [options] { return run(*options); };
}

}  // namespace hmlfc::tb
