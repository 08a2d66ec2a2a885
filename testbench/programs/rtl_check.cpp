// check: every block of a stream, or a part of them, through the unit and the golden model.
#include <array>
#include <filesystem>
#include <string>

#include "programs/plan_options.hpp"
#include "systemc/bench.hpp"
#include "systemc/failure_folder.hpp"
#include "systemc/stream_image.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, kBlockKinds> kKindNames{
    "zero", "motion only", "motion and residual", "residual only", "key image"};

constexpr size_t kHistory = 128;

struct Options {
  std::string file;
  PlanOptions plan;
  std::string output = "out";
  Conditions conditions;
  bool random_conditions = false;
  bool json = false;
  bool coverage = false;
  bool answers_only = false;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("file", o.file, "The stream")->required();
  o.plan.add_to(app);
  app.add_option("--latency", o.conditions.latency, "Clocks from address to data")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  app.add_option("--stall", o.conditions.stall, "Permille of clocks without read data")
      ->check(CLI::Range(0, 990));
  app.add_option("--backpressure", o.conditions.backpressure, "Permille of clocks without ready")
      ->check(CLI::Range(0, 990));
  app.add_flag("--random-conditions", o.random_conditions, "Draw these by the seed");
  app.add_option("--output", o.output, "Folder in which failure/ID/ is created")
      ->capture_default_str();
  app.add_flag("--answers-only", o.answers_only, "Do not compare the stages of the trace port");
  app.add_flag("--coverage", o.coverage, "Print the functional coverage");
  app.add_flag("--json", o.json, "Print JSON");
}

std::string replay_command(const Options& o) {
  std::string text = fmt::format("./run rtl-check {} {}", o.file, o.plan.replay());
  if (o.random_conditions) {
    text += " --random-conditions";
  } else {
    text += fmt::format(" --latency {} --stall {} --backpressure {}", o.conditions.latency,
                        o.conditions.stall, o.conditions.backpressure);
  }
  if (o.answers_only) text += " --answers-only";
  return text;
}

RequestSource requests_of(const Options& o, const StreamImage& image) {
  if (image.golden() == nullptr) return listed_requests({{}, {0, 0, 1, 1, kRgb, 0, true}});
  return o.plan.requests(image.golden()->geometry(), image.golden()->header());
}

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

// Sent, received, compared and unchecked agree, and something was compared.
bool counts_agree(const ScoreCounts& counts) {
  return counts.sent == counts.received + counts.dropped &&
         counts.received == counts.compared + counts.unchecked && counts.compared != 0;
}

// What a finished run came to.
Json report_of(const Options& o, Bench& bench) {
  const ScoreCounts& c = bench.scoreboard().counts();
  const RunStatistics& run = bench.statistics();
  const auto blocks = static_cast<double>(c.received);
  const auto clocks = static_cast<double>(run.clocks);
  const auto& mismatch = bench.findings().first();
  Json report{{"file", o.file},
              {"seed", o.plan.plan.seed},
              {"replay", replay_command(o)},
              {"passed", !mismatch && counts_agree(c)},
              {"sent", c.sent},
              {"received", c.received},
              {"compared", c.compared},
              {"unchecked", c.unchecked},
              {"dropped", c.dropped},
              {"records", c.records},
              {"records_compared", c.records_compared},
              {"records_unchecked", c.records_unchecked},
              {"records_held", c.records_skipped},
              {"records_missing", c.records_missing},
              {"clocks", run.clocks},
              {"blocks_per_clock", ratio(blocks, clocks)},
              {"clocks_per_block", ratio(clocks, blocks)},
              {"level_blocks_per_clock", ratio(static_cast<double>(c.records), clocks)},
              {"bytes_read", run.bytes_read},
              {"bursts", bench.memory().read_bursts},
              {"bytes_per_block", ratio(static_cast<double>(run.bytes_read), blocks)},
              {"answer_stalls", bench.stream_counts().answer_stalls},
              {"seconds", run.seconds},
              {"blocks_per_second", ratio(blocks, run.seconds)},
              {"clocks_per_second", ratio(clocks, run.seconds)}};
  for (size_t k = 0; k < kBlockKinds; ++k) {
    report["level_blocks"][kKindNames[k]] = c.kind_records[k];
  }
  if (mismatch) report["mismatch"] = to_string(*mismatch);
  return report;
}

Json check(const Options& o, std::span<const uint8_t> file, const UnitMaker& maker) {
  Bench bench;
  StreamImage image(file, maker.parameters);
  RecordedSource recorded(kHistory);
  const uint64_t seed = o.plan.plan.seed;
  bench.attach(maker.make(maker.parameters.with_state(seed), nullptr));
  if (o.answers_only) bench.compare_answers_only();
  if (o.random_conditions) bench.draw_places(seed);
  image.load_into(bench);
  if (!bench.findings().first()) {
    bench.begin_counting();
    bench.run(recorded.record(requests_of(o, image)), image.oracle(), o.conditions, seed);
    if (!bench.findings().first()) bench.check_counters();
  }
  Json report = report_of(o, bench);
  if (o.coverage) fmt::print(stderr, "{}", bench.coverage().report());
  if (const auto mismatch = bench.findings().first()) {
    const Failure failure{
        *mismatch, recorded.history(), replay_command(o),
        std::filesystem::path(o.file).stem().string() + "-seed-" + std::to_string(seed)};
    report["folder"] = keep_failure(bench, maker, image, failure, o.output).string();
  }
  return report;
}

int run(Options& o) {
  o.plan.apply();
  if (o.random_conditions) o.conditions = random_conditions(o.plan.plan.seed);
  const MappedFile file = read_file(o.file);
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, file.bytes());
  if (maker == nullptr) throw Stop{"this build has no Verilated unit (Verilator is missing)"};
  return with_replay(o.plan.plan.seed, replay_command(o),
                     [&] { return print_report(check(o, file.bytes(), *maker), o.json); });
}

}  // namespace

Command add_check(CLI::App& app) {
  auto options = std::make_shared<Options>();
  add_options(app, *options);
  return [options] { return run(*options); };
}

}  // namespace hmlfc::tb
