// hmlfc conform: runs decoders under test on the conformance suite.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/version.hpp>

#include "cli/arguments.hpp"
#include "cli/dut_options.hpp"
#include "conform/claim.hpp"
#include "conform/report.hpp"
#include "conform/runner.hpp"
#include "terminal/progress_bar.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kProgram = "hmlfc " HMLFC_VERSION;

struct ConformOptions {
  std::filesystem::path suite;
  DutOptions dut;
  conform::RunOptions run;
  std::vector<std::string> merge;
  std::filesystem::path claim;   // to write; empty: none
  std::filesystem::path verify;  // to check; empty: none
  bool run_claimed = false;      // run the decoder that the claim names
  bool frames = false;           // the suite's frames, for renderers
  bool force = false;
  bool json = false;
};

terminal::OffTerminal off_terminal(const ConformOptions& options) {
  return options.json ? terminal::OffTerminal::kSilent : terminal::OffTerminal::kLines;
}

// The folder of the report, of which an earlier one may be replaced.
io::FolderLock take_report_folder(const ConformOptions& options) {
  const std::filesystem::path& folder = options.run.folder;
  const Replacing replacing{"HMLFC conformance", options.force};
  const bool reported = std::filesystem::exists(folder / "report.html");
  make_output_folder(folder,
                     reported ? std::vector<std::string>{"report.html"}
                              : std::vector<std::string>{"report.json", "junit.xml"},
                     replacing);
  return take_output_folder(folder);
}

// Writes the reports; the exit status is that of the worst decoder.
ExitCode finish(const conform::Report& report, const ConformOptions& options) {
  value_or_throw(write_report(report, options.run.folder), ExitCode::kOutput);
  if (options.json) {
    print_json(conform::to_json(report));
  } else {
    for (const conform::Run& run : report.runs) print(terminal_text(run));
    print(fmt::format("Report: {}\n", (options.run.folder / "report.html").string()));
  }
  auto worst = conform::Verdict::kConforms;
  for (const conform::Run& run : report.runs) worst = std::max(worst, verdict(run));
  constexpr ExitCode kCodes[] = {ExitCode::kDone, ExitCode::kDone, ExitCode::kIncomplete,
                                 ExitCode::kDifferent};
  return kCodes[static_cast<size_t>(worst)];
}

ExitCode run_merge(const ConformOptions& options) {
  if (!options.dut.names.empty()) throw Failure(ExitCode::kUsage, "--merge takes no --dut");
  std::vector<conform::ReportPart> parts;
  for (const std::filesystem::path folder : options.merge) {
    parts.push_back(
        {folder, value_or_throw(conform::read_report(folder / "report.json"), ExitCode::kInput)});
  }
  const auto lock = take_report_folder(options);
  return finish(value_or_throw(conform::merge(parts, options.run.folder), ExitCode::kInput),
                options);
}

// A claim is about one decoder and the whole suite.
void check_whole(const ConformOptions& options, const std::string& option) {
  const conform::Selection& selection = options.run.selection;
  if (options.dut.names.size() != 1 || !selection.filters.empty() || !selection.milestone.empty() ||
      selection.shards != 1) {
    throw Failure(ExitCode::kUsage,
                  option + " takes one --dut and no --filter, --milestone or --shard");
  }
}

conform::Claim claim_on(const conform::Suite& suite, const conform::Dut& dut,
                        const std::string& dut_text) {
  return value_or_throw(conform::claim_of(suite, dut, dut_text), ExitCode::kInput);
}

// The suite, which has each vector of the part to be run that the decoders waive.
conform::Suite suite_for(const std::vector<conform::Dut>& duts, const ConformOptions& options) {
  auto suite = value_or_throw(conform::open_suite(options.suite, options.frames), ExitCode::kInput);
  for (const conform::Dut& dut : duts) {
    for (const auto& [id, reason] : dut.waivers) {
      if (id.starts_with("frames/") != options.frames || suite.manifest.find(id) != nullptr)
        continue;
      throw Failure(ExitCode::kUsage, fmt::format("{}: it waives {}, which the suite does not have",
                                                  dut.name, io::shown_json(id)));
    }
  }
  return suite;
}

// What differs from the claim; before the run as far as it is known then.
std::optional<std::string> verify_again(const conform::Claim& claimed,
                                        const ConformOptions& options) {
  const auto duts = options.dut.read();
  const conform::Dut& dut = duts.front();
  const auto suite = suite_for(duts, options);
  auto found = claim_on(suite, dut, claimed.at("decoder").at("dut").get<std::string>());
  if (auto difference = conform::claim_difference(claimed, found)) return difference;
  const auto lock = take_report_folder(options);
  terminal::ProgressBar progress(dut.name, "vectors", off_terminal(options));
  const auto run =
      value_or_throw(run_suite(suite, dut, options.run, progress.callback()), ExitCode::kOutput);
  const auto system = conform::this_system(kProgram);
  value_or_throw(
      conform::write_report({suite.manifest.vectors_version, suite.manifest_sha256, system, {run}},
                            options.run.folder),
      ExitCode::kOutput);
  add_results(found, run, system);
  return conform::claim_difference(claimed, found);
}

// The decoder that a claim names is run only where the user says so.
void choose_decoder(const conform::Claim& claimed, ConformOptions& options) {
  if (!options.dut.names.empty()) {
    if (!options.run_claimed) return;
    throw Failure(ExitCode::kUsage, "give --dut or --run-claimed, not both");
  }
  const Json named = claimed.at("decoder").at("dut").get<std::string>();
  if (!options.run_claimed) {
    const std::string shown = named.dump(-1, ' ', true, Json::error_handler_t::replace);
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: nothing was run: the claim names the decoder {}; give "
                              "--run-claimed to run it, or your own with --dut",
                              options.verify.string(), shown));
  }
  options.dut.names = {named};
}

ExitCode run_verify(ConformOptions options) {
  const auto claimed = value_or_throw(conform::read_claim(options.verify), ExitCode::kInput);
  choose_decoder(claimed, options);
  check_whole(options, "--verify");
  options.frames = claimed.at("suite").value("part", "") == "frames";
  const auto difference = verify_again(claimed, options);
  const std::string told = difference
                               ? "differs: " + *difference
                               : fmt::format("verified, {} results", claimed.at("results").size());
  print_result(options.json, {{"verified", !difference}, {"difference", difference.value_or("")}},
               fmt::format("{}: {}\n", options.verify.string(), told));
  return difference ? ExitCode::kDifferent : ExitCode::kDone;
}

// Milestones and command lines are either of decoders or of renderers.
void check_frames(const ConformOptions& options, const std::vector<conform::Dut>& duts) {
  const std::string& name = options.run.selection.milestone;
  const bool of_frames = &vectors::milestones_with(name) == &vectors::frame_milestones();
  if (!name.empty() && of_frames != options.frames) {
    throw Failure(ExitCode::kUsage, name + (of_frames ? " is a milestone of renderers: add --frames"
                                                      : " is no milestone of renderers: leave out "
                                                        "--frames"));
  }
  for (const conform::Dut& dut : duts) {
    if (options.frames && dut.waiting == nullptr && dut.frame.empty() && dut.disparity.empty()) {
      throw Failure(ExitCode::kUsage,
                    dut.name + ": a renderer's command line has {record} or {camera}");
    }
    if (!options.frames && dut.waiting == nullptr && dut.command.empty()) {
      throw Failure(ExitCode::kUsage, dut.name + ": a renderer is checked with --frames");
    }
  }
}

ExitCode run_conform(const ConformOptions& given) {
  ConformOptions options = given;
  if (!options.merge.empty()) return run_merge(options);
  options.run.limits = options.dut.limits();
  if (!options.verify.empty()) return run_verify(options);
  const auto duts = options.dut.read();
  check_frames(options, duts);
  if (!options.claim.empty()) {
    check_whole(options, "--claim");
    check_replaceable({options.claim}, {R"("manifest_sha256")", options.force});
  }
  const auto suite = suite_for(duts, options);
  for (const std::string& pattern : options.run.selection.filters) {
    const auto fits = [&](const auto& vector) { return vectors::matches(vector, pattern); };
    if (std::ranges::any_of(suite.manifest.vectors, fits)) continue;
    throw Failure(ExitCode::kUsage, fmt::format("--filter {}: no vector fits", pattern));
  }
  const auto lock = take_report_folder(options);
  conform::Report report{
      suite.manifest.vectors_version, suite.manifest_sha256, conform::this_system(kProgram), {}};
  for (const conform::Dut& dut : duts) {
    terminal::ProgressBar progress(dut.name, "vectors", off_terminal(options));
    report.runs.push_back(
        value_or_throw(run_suite(suite, dut, options.run, progress.callback()), ExitCode::kOutput));
  }
  const ExitCode code = finish(report, options);
  if (!options.claim.empty()) {
    if (code != ExitCode::kDone) {
      throw Failure(code, "no claim is written: the verdict is \"" +
                              verdict_text(report.runs.front()) + "\"");
    }
    auto claim = claim_on(suite, duts.front(), options.dut.names.front());
    conform::add_results(claim, report.runs.front(), report.system);
    value_or_throw(conform::write_claim(options.claim, claim), ExitCode::kOutput);
    if (!options.json) print(fmt::format("Claim: {}\n", options.claim.string()));
  }
  return code;
}

constexpr const char* kConformFooter =
    R"(A decoder is one of
  - a command line with {input} and {output}: it writes the views to the folder {output}, either as
    `hmlfc decode` does or as views.raw;
  - "lines:" and a command line: a program that speaks the line protocol (docs/line_protocol.md);
  - a shared library *.so with the functions of hmlfc_dut.h;
  - a file *.json that declares one of these with name, profile, level, limits, trace, waivers.
{hmlfc} stands for this program. docs/conformance.md is a guided tour.
With --frames it is a renderer: a command line gets {record}, 41 numbers, or {camera}, and writes
frame.raw, frame.png or frame.ppm.

Results: pass, fail, error (did not start, crashed), timeout, not_supported (beyond what the decoder
claims), skipped (required but not run; never a pass). The output folder gets report.html and
report.json.

A vector of group error counts only if its base, the valid stream that it is made from, passes; bases
are run with every selection.

Exit status 0: all required vectors pass, those of --milestone if it is given; 1: a required vector
fails, or a claim differs; 5: no failures, but required vectors were skipped.

A decoder runs with your rights. A claim's command is shown, and run only with --run-claimed.

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
  app.add_flag("--frames", options.frames, "The suite's frames, for a renderer");
  app.add_option("--filter", options.run.selection.filters,
                 "Only vectors whose id, profile, clause or flag matches, with * and ?")
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  add_milestone(app, options.run.selection.milestone);
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
  add_path(app, "--claim", options.claim, "Write what a conforming decoder claims to this file")
      ->required(false)
      ->type_name("FILE");
  add_path(app, "--verify", options.verify, "Check a claim by running the decoder again, of --dut")
      ->required(false)
      ->type_name("FILE");
  app.add_flag("--run-claimed", options.run_claimed,
               "With --verify: run the decoder that the claim names")
      ->needs("--verify");
  add_json(app, options.json);
  add_output(app, options.run.folder, options.force, "DIR",
             "Folder for the report, created if missing");
}

}  // namespace hmlfc::cli
