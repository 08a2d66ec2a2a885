// hmlfc conform: decoders under test on the suite of vectors.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/version.hpp>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/dut_options.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "conform/report_files.hpp"
#include "conform/report_json.hpp"
#include "conform/runner.hpp"

namespace hmlfc::cli {
namespace {

struct ConformOptions {
  std::filesystem::path suite = "vectors";
  DutOptions dut;
  std::vector<std::string> filters;
  std::optional<std::array<uint32_t, 2>> shard;
  std::filesystem::path folder;
  std::vector<std::string> merge;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool resume = false;
  bool keep = false;
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

// Writes the reports; the status is that of the worst decoder.
ExitCode finish(const conform::Report& report, const ConformOptions& options) {
  value_or_throw(write_report(report, options.folder), ExitCode::kOutput);
  if (options.json) {
    print_json(conform::to_json(report));
  } else {
    for (const conform::Run& run : report.runs) print_run(run);
    print(fmt::format("Report: {}\n", (options.folder / "report.html").string()));
  }
  auto worst = conform::Verdict::kConforms;
  for (const conform::Run& run : report.runs) worst = std::max(worst, verdict(run));
  switch (worst) {
    case conform::Verdict::kConforms:
      return ExitCode::kDone;
    case conform::Verdict::kIncomplete:
      return ExitCode::kIncomplete;
    case conform::Verdict::kFails:
      break;
  }
  return ExitCode::kDifferent;
}

ExitCode run_merge(const ConformOptions& options) {
  if (!options.dut.names.empty()) throw Failure(ExitCode::kUsage, "--merge takes no --dut");
  std::vector<conform::ReportPart> parts;
  for (const std::filesystem::path folder : options.merge) {
    parts.push_back(
        {folder, value_or_throw(conform::read_report(folder / "report.json"), ExitCode::kInput)});
  }
  make_output_folder(options.folder);
  return finish(value_or_throw(conform::merge(parts, options.folder), ExitCode::kInput), options);
}

conform::RunOptions run_options(const ConformOptions& options) {
  conform::RunOptions run;
  run.folder = options.folder;
  run.selection.filters = options.filters;
  if (options.shard) {
    run.selection.shard = (*options.shard)[0];
    run.selection.shards = (*options.shard)[1];
  }
  run.limits = options.dut.limits();
  run.jobs = options.jobs;
  run.resume = options.resume;
  run.keep = options.keep;
  return run;
}

ExitCode run_conform(const ConformOptions& options) {
  if (!options.merge.empty()) return run_merge(options);
  const auto duts = options.dut.read();
  const auto suite = value_or_throw(conform::open_suite(options.suite), ExitCode::kInput);
  make_output_folder(options.folder);
  conform::Report report{suite.manifest.vectors_version,
                         suite.manifest_sha256,
                         conform::this_system("hmlfc " HMLFC_VERSION),
                         {}};
  for (const conform::Dut& dut : duts) {
    ProgressBar progress(dut.name, "vectors");
    report.runs.push_back(value_or_throw(
        run_suite(suite, dut, run_options(options), progress.callback()), ExitCode::kOutput));
  }
  return finish(report, options);
}

void add_shard(CLI::App& app, std::optional<std::array<uint32_t, 2>>& target) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    target = parse_numbers<2>(text, '/');
    if (!target || (*target)[0] < 1 || (*target)[0] > (*target)[1]) {
      return "I/N with 1 <= I <= N, as 1/4";
    }
    return std::nullopt;
  };
  add_value(app, "--shard", "I/N", "Run part I of N; see --merge", reader);
}

constexpr const char* kConformFooter =
    R"(A decoder is a command line with {input} and {output}, which writes the views into the folder {output}
as `hmlfc decode` does, or as views.raw; a shared library *.so with the functions of hmlfc_dut.h; or a
file *.json that declares a command or library with name, profile, level, limits, trace and waivers.
{hmlfc} stands for this program. docs/conformance.md leads through all of it.

Results: pass, fail, error (cannot be started, crashed), timeout, not_supported (beyond what the
decoder claims), skipped (required, but not run; never a pass). The report's folder gets report.html,
report.json and junit.xml.

Exit status 0: every required vector passes; 1: one does not; 5: nothing failed, but required vectors
were not run.

Example:
  hmlfc conform --dut '{hmlfc} decode {input} -o {output}' --suite vectors -o report)";

}  // namespace

void add_conform(CLI::App& program, Task& task) {
  const auto options = std::make_shared<ConformOptions>();
  CLI::App* app = program.add_subcommand("conform", "Test a decoder with the conformance suite");
  add_path(*app, "--suite", options->suite, "Folder of the vectors")
      ->required(false)
      ->type_name("DIR")
      ->default_str("vectors");
  options->dut.add_to(*app, true);
  app->add_option("--filter", options->filters,
                  "Only vectors whose id, a clause or a flag fits, with * and ?")
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  add_integer(*app, "-j,--jobs", options->jobs, 1, 1024, "Vectors at the same time");
  add_shard(*app, options->shard);
  app->add_option("--merge", options->merge, "Make one report of those in these folders")
      ->type_name("DIR");
  app->add_flag("--resume", options->resume, "Keep the results that an interrupted run left");
  app->add_flag("--keep", options->keep, "Keep what the decoder wrote for vectors that fail");
  app->add_flag("--json", options->json, "Print the report as JSON");
  add_output(*app, options->folder, "DIR", "Folder for the report, made if it is missing");
  app->footer(kConformFooter);
  app->callback([&task, options] { task = [options] { return run_conform(*options); }; });
}

}  // namespace hmlfc::cli
