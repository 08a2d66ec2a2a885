// rtl-check: every block of a stream, or a part of them, through the unit and the golden model.
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "io/files.hpp"
#include "programs/plan_options.hpp"
#include "stimulus/sequences.hpp"
#include "syntax/header.hpp"
#include "systemc/bench.hpp"
#include "systemc/failure_folder.hpp"
#include "systemc/stream_image.hpp"
#include "unit/stand_in.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

// One finished run.
struct CheckReport {
  std::string file;
  std::string unit;  ///< name of the implementation
  uint64_t seed = 0;
  std::string replay;
  ScoreCounts counts;
  StreamCounts stream;
  MemoryCounts memory;
  RunStatistics statistics;
  std::optional<Mismatch> mismatch;
  std::string folder;  ///< of the failure

  // Sent, received, compared and unchecked agree.
  bool counts_agree() const {
    return counts.sent == counts.received + counts.dropped &&
           counts.received == counts.compared + counts.unchecked;
  }

  bool passed() const { return !mismatch && counts_agree() && counts.compared != 0; }
};

constexpr std::array<const char*, kBlockKinds> kKindNames{
    "zero", "motion only", "motion and residual", "residual only", "key image"};

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

double kind_clocks(const CheckReport& report, size_t kind) {
  return ratio(static_cast<double>(report.counts.kind_clocks[kind]),
               static_cast<double>(report.counts.kind_records[kind]));
}

struct Figures {
  double blocks_per_clock;
  double clocks_per_block;
  double level_blocks_per_clock;
  double bytes_per_block;
  double blocks_per_second;
  double clocks_per_second;
};

Figures figures(const CheckReport& report) {
  const auto blocks = static_cast<double>(report.counts.received);
  const auto clocks = static_cast<double>(report.statistics.clocks);
  return {ratio(blocks, clocks),
          ratio(clocks, blocks),
          ratio(static_cast<double>(report.counts.records), clocks),
          ratio(static_cast<double>(report.statistics.bytes_read), blocks),
          ratio(blocks, report.statistics.seconds),
          ratio(clocks, report.statistics.seconds)};
}

std::string to_text(const CheckReport& report) {
  const ScoreCounts& c = report.counts;
  const Figures f = figures(report);
  std::string text = fmt::format(
      "{}: {} sent, {} received, {} compared, {} unchecked, {} dropped\n"
      "stages: {} records, {} compared, {} unchecked, {} held chroma, {} missing after errors\n"
      "{} clocks: {:.4f} blocks a clock, {:.2f} clocks a block, {:.3f} level blocks a clock\n"
      "read: {} bytes in {} bursts, {:.1f} bytes a block; {} clocks of answers waiting\n",
      report.unit, c.sent, c.received, c.compared, c.unchecked, c.dropped, c.records,
      c.records_compared, c.records_unchecked, c.records_skipped, c.records_missing,
      report.statistics.clocks, f.blocks_per_clock, f.clocks_per_block, f.level_blocks_per_clock,
      report.statistics.bytes_read, report.memory.bursts, f.bytes_per_block,
      report.stream.answer_stalls);
  for (size_t k = 0; k < kBlockKinds; ++k) {
    text += fmt::format("  {:<20} {:>10} level blocks, {:.2f} clocks each\n", kKindNames[k],
                        c.kind_records[k], kind_clocks(report, k));
  }
  text += fmt::format("simulated: {:.0f} blocks/s, {:.0f} clocks/s in {:.2f} s\n",
                      f.blocks_per_second, f.clocks_per_second, report.statistics.seconds);
  if (report.mismatch) text += "MISMATCH: " + to_string(*report.mismatch) + "\n";
  if (!report.folder.empty()) text += "kept in " + report.folder + "\n";
  if (!report.counts_agree() && !report.mismatch) text += "COUNTS DO NOT AGREE\n";
  text += report.passed() ? "equal to the model\n" : "FAILED\n";
  return text;
}

std::string to_json(const CheckReport& report) {
  const ScoreCounts& c = report.counts;
  const Figures f = figures(report);
  nlohmann::ordered_json json{{"file", report.file},
                              {"unit", report.unit},
                              {"seed", report.seed},
                              {"replay", report.replay},
                              {"passed", report.passed()},
                              {"sent", c.sent},
                              {"received", c.received},
                              {"compared", c.compared},
                              {"unchecked", c.unchecked},
                              {"dropped", c.dropped},
                              {"records", c.records},
                              {"records_compared", c.records_compared},
                              {"records_unchecked", c.records_unchecked},
                              {"records_held", c.records_skipped},
                              {"clocks", report.statistics.clocks},
                              {"blocks_per_clock", f.blocks_per_clock},
                              {"clocks_per_block", f.clocks_per_block},
                              {"level_blocks_per_clock", f.level_blocks_per_clock},
                              {"bytes_read", report.statistics.bytes_read},
                              {"bursts", report.memory.bursts},
                              {"bytes_per_block", f.bytes_per_block},
                              {"answer_stalls", report.stream.answer_stalls},
                              {"seconds", report.statistics.seconds},
                              {"blocks_per_second", f.blocks_per_second},
                              {"clocks_per_second", f.clocks_per_second}};
  for (size_t k = 0; k < kBlockKinds; ++k) {
    json["level_blocks"][kKindNames[k]] = {{"count", c.kind_records[k]},
                                           {"clocks", kind_clocks(report, k)}};
  }
  if (report.mismatch) json["mismatch"] = to_string(*report.mismatch);
  if (!report.folder.empty()) json["folder"] = report.folder;
  return json.dump(2) + "\n";
}

constexpr int kExitDifferent = 1;
constexpr int kExitUsage = 2;
constexpr size_t kHistory = 128;

struct Options {
  std::string file;
  std::string views = "1";
  std::string unit = "rtl";
  std::string order = "scan";
  std::string output = "out";
  ScanPlan plan;
  Conditions conditions;
  uint64_t mixed = 0;
  bool random_conditions = false;
  bool json = false;
  bool coverage = false;
  bool answers_only = false;
};

int usage_error(const std::string& message) {
  fmt::print(stderr, "rtl-check: {}\n", message);
  return kExitUsage;
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("file", o.file, "The stream")->required();
  add_plan_options(app, o.views, o.order, o.plan, o.mixed);
  app.add_option("--latency", o.conditions.latency, "Clocks from address to data")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  app.add_option("--stall", o.conditions.stall, "Permille of clocks without read data")
      ->check(CLI::Range(0, 990));
  app.add_option("--backpressure", o.conditions.backpressure, "Permille of clocks without ready")
      ->check(CLI::Range(0, 990));
  app.add_flag("--random-conditions", o.random_conditions, "Draw these by the seed");
  app.add_option("--unit", o.unit, "rtl or stand-in")
      ->check(CLI::IsMember({"rtl", "stand-in"}))
      ->capture_default_str();
  app.add_option("--output", o.output, "Folder in which failure/ID/ is created")
      ->capture_default_str();
  app.add_flag("--answers-only", o.answers_only, "Do not compare the stages of the trace port");
  app.add_flag("--coverage", o.coverage, "Print the functional coverage");
  app.add_flag("--json", o.json, "Print JSON");
}

std::string replay_command(const Options& o) {
  std::string text = fmt::format("./run rtl-check {} --seed {}", o.file, o.plan.seed);
  if (o.mixed != 0) text += fmt::format(" --mixed {}", o.mixed);
  if (o.mixed == 0) text += fmt::format(" --views {} --order {}", o.views, o.order);
  if (o.plan.plane != kRgb) text += fmt::format(" --plane {}", o.plan.plane);
  if (o.plan.stop_level != 0) text += fmt::format(" --stop-level {}", o.plan.stop_level);
  if (o.plan.fraction < 1) text += fmt::format(" --fraction {}", o.plan.fraction);
  if (o.random_conditions) {
    text += " --random-conditions";
  } else {
    text += fmt::format(" --latency {} --stall {} --backpressure {}", o.conditions.latency,
                        o.conditions.stall, o.conditions.backpressure);
  }
  if (o.answers_only) text += " --answers-only";
  if (o.unit != "rtl") text += " --unit " + o.unit;
  return text;
}

// The unit for the stream, whatever its header says, or one of any parameters.
std::optional<UnitMaker> choose_unit(const Options& o, std::span<const uint8_t> file) {
  const auto header = parse_header(file);
  if (o.unit == "stand-in") {
    UnitParameters parameters{2, 12, 16, 16};
    if (header) parameters.block_log2 = header->block_log2;
    return UnitMaker{"stand-in", parameters, &StandIn::make};
  }
  const auto makers = rtl_units();
  if (makers.empty()) return std::nullopt;
  const UnitMaker* fitting = header ? unit_for(makers, header->block_log2, header->depth) : nullptr;
  return fitting != nullptr ? *fitting : makers.front();
}

RequestSource requests_of(const Options& o, const StreamImage& image) {
  if (image.golden() == nullptr) return listed_requests({{}, {0, 0, 1, 1, kRgb, 0, true}});
  const Geometry& geometry = image.golden()->geometry();
  const StreamHeader& header = image.golden()->header();
  if (o.mixed != 0) return mixed_requests(geometry, header, o.mixed, o.plan.seed, 30);
  return scan_requests(geometry, header, o.plan);
}

CheckReport check(const Options& o, std::span<const uint8_t> file, const UnitMaker& maker) {
  Bench bench;
  StreamImage image(file, maker.parameters);
  RecordedSource recorded(kHistory);
  bench.attach(maker.make(maker.parameters));
  if (o.answers_only) bench.compare_answers_only();
  image.load_into(bench);
  if (!bench.findings().first()) {
    bench.begin_counting();
    bench.run(recorded.record(requests_of(o, image)), image.oracle(), o.conditions, o.plan.seed);
    if (!bench.findings().first()) bench.check_counters();
  }
  CheckReport report{o.file,
                     maker.name,
                     o.plan.seed,
                     replay_command(o),
                     bench.scoreboard().counts(),
                     bench.stream_counts(),
                     bench.memory().counts(),
                     bench.statistics(),
                     bench.findings().first(),
                     {}};
  if (o.coverage) fmt::print(stderr, "{}", bench.coverage().report());
  if (report.mismatch) {
    const Failure failure{
        *report.mismatch, recorded.history(), report.replay,
        std::filesystem::path(o.file).stem().string() + "-seed-" + std::to_string(o.plan.seed)};
    report.folder = keep_failure(bench, maker, image, failure, o.output).string();
  }
  return report;
}

int run(int argc, char** argv) {
  CLI::App app{"Checks blocks of a stream against the golden model"};
  Options o;
  add_options(app, o);
  CLI11_PARSE(app, argc, argv);
  o.plan.random_order = o.order == "random";
  if (o.views == "all") {
    o.plan.views = ~uint64_t{0};
  } else if (!CLI::detail::lexical_cast(o.views, o.plan.views) || o.plan.views == 0) {
    return usage_error("--views is a number or all");
  }
  if (o.random_conditions) o.conditions = random_conditions(o.plan.seed);
  const auto file = io::MappedFile::open(o.file);
  if (!file) return usage_error(file.error().message);
  const auto maker = choose_unit(o, file->bytes());
  if (!maker) return usage_error("this build has no Verilated unit (Verilator is missing)");
  const std::string head = fmt::format("seed {}, replay: {}\n", o.plan.seed, replay_command(o));
  fmt::print(stderr, "{}", head);
  const CheckReport report = check(o, file->bytes(), *maker);
  fmt::print("{}", o.json ? to_json(report) : to_text(report));
  std::fflush(stdout);
  fmt::print(stderr, "{}", head);
  return report.passed() ? 0 : kExitDifferent;
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::run(argc, argv); }
