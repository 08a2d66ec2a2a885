// hmlfc conform: runs decoders under test on the conformance suite.
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <hmlfc/version.hpp>

#include "cli/arguments.hpp"
#include "cli/dut_options.hpp"
#include "conform/report.hpp"
#include "conform/runner.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

struct ConformOptions {
  std::filesystem::path suite = "vectors";
  DutOptions dut;
  conform::RunOptions run;
  std::vector<std::string> merge;
  bool json = false;
};

// The line of a vector that did not pass.
std::string line_of(const conform::VectorResult& result) {
  std::string line =
      fmt::format("  {:<13} {}: {}\n", status_name(result.status), result.id, result.reason);
  if (!result.stage.empty()) line += fmt::format("                {}\n", result.stage);
  if (result.bad() && !result.clauses.empty()) {
    line += fmt::format("                clauses {}\n", fmt::join(result.clauses, " "));
  }
  if (result.waived()) line += fmt::format("                waived: {}\n", result.waiver);
  return line;
}

void print_run(const conform::Run& run) {
  for (const conform::VectorResult& result : run.results) {
    if (result.bad()) print(line_of(result));
  }
  const conform::Tally counts = tally(run);
  std::string line = fmt::format("{}: {}:", run.dut, verdict_text(run));
  for (size_t i = 0; i < conform::kStatusCount; ++i) {
    if (counts.count[i] == 0) continue;
    line += fmt::format(" {} {},", counts.count[i], status_name(static_cast<conform::Status>(i)));
  }
  if (counts.waived != 0) line += fmt::format(" {} waived,", counts.waived);
  line += fmt::format(" of {} vectors\n", run.results.size());
  print(line);
}

// Writes the reports; the exit status is that of the worst decoder.
ExitCode finish(const conform::Report& report, const ConformOptions& options) {
  value_or_throw(write_report(report, options.run.folder), ExitCode::kOutput);
  if (options.json) {
    print_json(conform::to_json(report));
  } else {
    for (const conform::Run& run : report.runs) print_run(run);
    print(fmt::format("Report: {}\n", (options.run.folder / "report.html").string()));
  }
  auto worst = conform::Verdict::kConforms;
  for (const conform::Run& run : report.runs) worst = std::max(worst, verdict(run));
  constexpr ExitCode kCodes[] = {ExitCode::kDone, ExitCode::kIncomplete, ExitCode::kDifferent};
  return kCodes[static_cast<size_t>(worst)];
}

ExitCode run_merge(const ConformOptions& options) {
  if (!options.dut.names.empty()) throw Failure(ExitCode::kUsage, "--merge takes no --dut");
  std::vector<conform::ReportPart> parts;
  for (const std::filesystem::path folder : options.merge) {
    parts.push_back(
        {folder, value_or_throw(conform::read_report(folder / "report.json"), ExitCode::kInput)});
  }
  make_output_folder(options.run.folder);
  return finish(value_or_throw(conform::merge(parts, options.run.folder), ExitCode::kInput),
                options);
}

ExitCode run_conform(const ConformOptions& given) {
  ConformOptions options = given;
  if (!options.merge.empty()) return run_merge(options);
  options.run.limits = options.dut.limits();
  const auto duts = options.dut.read();
  const auto suite = value_or_throw(conform::open_suite(options.suite), ExitCode::kInput);
  make_output_folder(options.run.folder);
  conform::Report report{suite.manifest.vectors_version,
                         suite.manifest_sha256,
                         conform::this_system("hmlfc " HMLFC_VERSION),
                         {}};
  for (const conform::Dut& dut : duts) {
    terminal::ProgressBar progress(dut.name, "vectors");
    report.runs.push_back(
        value_or_throw(run_suite(suite, dut, options.run, progress.callback()), ExitCode::kOutput));
  }
  return finish(report, options);
}

constexpr const char* kConformFooter =
    R"(A decoder is one of
  - a command line with {input} and {output}: it writes the views to the folder {output}, either as
    `hmlfc decode` does or as views.raw;
  - "lines:" and a command line: a program that speaks the line protocol (docs/line_protocol.md);
  - a shared library *.so with the functions of hmlfc_dut.h;
  - a file *.json that declares one of these with name, profile, level, limits, trace, waivers.
{hmlfc} stands for this program. docs/conformance.md is a guided tour.

Results: pass, fail, error (did not start, crashed), timeout, not_supported (beyond what the decoder
claims), skipped (required but not run; never a pass). The output folder gets report.html, report.json
and junit.xml.

Exit status 0: all required vectors pass; 1: a required vector fails; 5: no failures, but required
vectors were skipped.

Example:
  hmlfc conform --dut '{hmlfc} decode {input} -o {output}' --suite vectors -o report)";

}  // namespace

void add_conform(CLI::App& program, Task& task) {
  const auto [app, options] =
      add_command(program, task, "conform", "Test a decoder with the conformance suite",
                  run_conform, kConformFooter);
  add_suite(app, options.suite, "Folder of the vectors");
  options.run.jobs = std::max(1u, std::thread::hardware_concurrency());
  options.dut.add_to(app, true);
  app.add_option("--filter", options.run.selection.filters,
                 "Only vectors whose id, clause or flag matches, with * and ?")
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  add_integer(app, "-j,--jobs", options.run.jobs, 1, 1024, "Vectors to run in parallel");
  const auto set_shard = [&run = options.run.selection](const std::array<uint32_t, 2>& numbers) {
    run.shard = numbers[0];
    run.shards = numbers[1];
    return run.shard >= 1 && run.shard <= run.shards;
  };
  add_numbers<2>(app, "--shard", "I/N", '/', "I/N with 1 <= I <= N, such as 1/4",
                 "Run part I of N; see --merge", set_shard);
  app.add_option("--merge", options.merge, "Merge the reports in these folders into one")
      ->type_name("DIR");
  app.add_flag("--resume", options.run.resume, "Keep the results of an interrupted run");
  app.add_flag("--keep", options.run.keep, "Keep the decoder's output for vectors that fail");
  add_json(app, options.json);
  add_output(app, options.run.folder, "DIR", "Folder for the report, created if missing");
}

}  // namespace hmlfc::cli
