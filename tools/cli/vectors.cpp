// hmlfc vectors: makes the conformance suite, lists and examines it.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"
#include "cli/vector_explanation.hpp"
#include "cli/view_source.hpp"
#include "io/files.hpp"
#include "io/image_files.hpp"
#include "io/pictures.hpp"
#include "terminal/progress_bar.hpp"
#include "vectors/examine.hpp"
#include "vectors/generate.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::cli {

namespace {

// Every command uses a part of these.
struct SuiteOptions {
  std::filesystem::path suite;
  std::string id;
  std::string group;
  std::string milestone;
  std::string clause;
  std::filesystem::path output;
  bool force = false;
  int threads = 0;
  bool frames = false;
  bool json = false;
};

// The manifest of the suite, for renderers where the options are about frames; a failure (kInput)
// where it cannot be read.
vectors::Manifest manifest_of(const SuiteOptions& options) {
  auto manifest = value_or_throw(vectors::read_manifest(options.suite), ExitCode::kInput);
  const bool frames = options.frames || options.id.starts_with("frames/") ||
                      options.group == "frames" ||
                      &vectors::milestones_with(options.milestone) == &vectors::frame_milestones();
  return frames ? vectors::frames_of(std::move(manifest)) : manifest;
}

// The vector that the options name; a usage failure where there is none.
const vectors::Vector& vector_of(const vectors::Manifest& manifest, const SuiteOptions& options) {
  if (const vectors::Vector* found = manifest.find(options.id)) return *found;
  throw Failure(ExitCode::kUsage,
                fmt::format("there is no vector {}; hmlfc vectors list{} shows them all",
                            options.id, options.id.starts_with("frames/") ? " --frames" : ""));
}

bool is_chosen(const vectors::Vector& vector, const SuiteOptions& options) {
  if (!options.group.empty() && vector.group != options.group) return false;
  if (!options.milestone.empty() && vector.milestone != options.milestone) return false;
  if (options.clause.empty()) return true;
  return std::ranges::find(vector.clauses, options.clause) != vector.clauses.end();
}

ExitCode run_list(const SuiteOptions& options) {
  const vectors::Manifest manifest = manifest_of(options);
  Json rows = Json::array();
  std::string text;
  size_t count = 0;
  for (const vectors::Vector& vector : manifest.vectors) {
    if (!is_chosen(vector, options)) continue;
    ++count;
    rows.push_back({{"id", vector.id.text()},
                    {"profile", profile_name(vector.profile)},
                    {"level", vector.level},
                    {"bytes", vector.input.bytes},
                    {"milestone", vector.milestone},
                    {"outcome", vectors::outcome_name(vector.expect.outcome)}});
    text += fmt::format("{:44} {:9} {} {:>9}  {:16} {}\n", vector.id.text(),
                        profile_name(vector.profile), vector.level, grouped(vector.input.bytes),
                        vector.milestone, expectation_text(vector.expect));
  }
  const char* others = count != 0       ? ""
                       : options.frames ? ": see also without --frames"
                                        : ": see also --frames, for renderers";
  text += fmt::format("{} of {} vectors, version {}{}\n", count, manifest.vectors.size(),
                      manifest.vectors_version, others);
  print_result(options.json, rows, text);
  return ExitCode::kDone;
}

ExitCode run_milestones(const SuiteOptions& options) {
  const vectors::Manifest manifest = manifest_of(options);
  Json rows = Json::array();
  std::string text;
  const auto& shown = options.frames ? vectors::frame_milestones() : vectors::milestones();
  for (const vectors::MilestoneRow& row : shown) {
    const auto count =
        std::ranges::count(manifest.vectors, std::string(row.name), &vectors::Vector::milestone);
    rows.push_back({{"name", row.name}, {"vectors", count}, {"claim", row.claim}});
    text += fmt::format("{:16} {:>4}  {}\n", row.name, count, row.claim);
  }
  print_result(options.json, rows, text);
  return ExitCode::kDone;
}

ExitCode run_explain(const SuiteOptions& options) {
  const vectors::Manifest manifest = manifest_of(options);
  print(explanation(options.suite, vector_of(manifest, options)));
  return ExitCode::kDone;
}

constexpr uint32_t kSheetWidth = 1024;

ExitCode run_show(const SuiteOptions& options) {
  const std::string sign = "hmlfc vectors";
  const OutputFile output = picture_file(options.output, {sign, options.force});
  const vectors::Manifest manifest = manifest_of(options);
  const StreamFile file(options.suite / vector_of(manifest, options).input.file);
  const StreamHeader& header = file.header();
  auto sheet = value_or_throw(
      io::ContactSheet::make({header.rows, header.cols, header.width, header.height, header.depth},
                             kSheetWidth),
      ExitCode::kInput);
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      sheet.draw(row, col, file.value(file.decoder().decode_view({row, col})));
    }
  }
  value_or_throw(io::write_png(output.path(), sheet.image(), sign), ExitCode::kOutput);
  output.finish();
  print(fmt::format("{}: {} x {} views\n", options.output.string(), header.rows, header.cols));
  return ExitCode::kDone;
}

ExitCode run_inspect(const SuiteOptions& options) {
  const vectors::Manifest manifest = manifest_of(options);
  const auto path = options.suite / vector_of(manifest, options).input.file;
  const auto file = value_or_throw(io::map_file(path), ExitCode::kInput);
  print(vectors::annotated_dump(file.bytes()));
  return ExitCode::kDone;
}

ExitCode run_lint(const SuiteOptions& options) {
  const vectors::Manifest manifest = manifest_of(options);
  const auto found = vectors::lint_suite(options.suite, manifest);
  for (const std::string& line : found) print(line + "\n");
  if (!found.empty()) return ExitCode::kDifferent;
  print(fmt::format("{} vectors: no problems\n", manifest.vectors.size()));
  return ExitCode::kDone;
}

ExitCode run_generate(const SuiteOptions& options) {
  terminal::ProgressBar progress("Generating", "vectors");
  const auto files = value_or_throw(
      vectors::generate_suite(options.suite / "recipes", static_cast<unsigned>(options.threads),
                              progress.callback()),
      ExitCode::kInput);
  progress.clear();
  const auto folder = options.output.empty() ? options.suite : options.output;
  std::vector<std::string> names;
  if (!std::filesystem::exists(folder / "manifest.json")) {
    for (const auto& [name, content] : files) names.push_back(name);
  }
  make_output_folder(folder, names, {"", options.force});
  value_or_throw(vectors::write_suite(files, folder), ExitCode::kOutput);
  uint64_t bytes = 0;
  for (const auto& [name, content] : files) bytes += content.size();
  print(fmt::format("{}: {} files, {} bytes\n", folder.string(), files.size(), grouped(bytes)));
  return ExitCode::kDone;
}

// Adds a command of `hmlfc vectors`, with --suite and, if it is about one vector, its ID.
Command<SuiteOptions> add_suite_command(CLI::App& vectors, Task& task, const std::string& name,
                                        const std::string& description, bool with_id,
                                        ExitCode (*run)(const SuiteOptions&),
                                        const std::string& footer) {
  const auto command = add_command(vectors, task, name, description, run, footer);
  if (with_id) {
    command.app.add_option("ID", command.options.id, "The vector, as group/name")
        ->required()
        ->type_name("");
  }
  add_suite(command.app, command.options.suite, "Folder of the suite");
  return command;
}

void add_frames(CLI::App& app, bool& target) {
  app.add_flag("--frames", target, "Of the frames, for renderers");
}

void add_list(CLI::App& vectors, Task& task) {
  const auto [app, options] = add_suite_command(
      vectors, task, "list", "List the vectors", false, run_list,
      R"(Columns: id, profile, conformance level, bytes of the stream, milestone, expected outcome.
JSON: a list of {id, profile, level, bytes, milestone, outcome}; manifest.json has everything.

Example:
  hmlfc vectors list --clause BISE-10)");
  app.add_option("--group", options.group, "Only the vectors of one group")->type_name("NAME");
  add_milestone(app, options.milestone);
  app.add_option("--clause", options.clause, "Only the vectors that exercise one clause")
      ->type_name("CLAUSE");
  add_frames(app, options.frames);
  add_json(app, options.json);
}

}  // namespace

void add_vectors(CLI::App& program, Task& task) {
  CLI::App* app = program.add_subcommand("vectors", "Make and examine the conformance suite");
  app->require_subcommand(1);
  app->footer("Example:\n  hmlfc vectors list --clause BISE-10");

  const auto [generate, generated] = add_suite_command(
      *app, task, "generate", "Make the suite from its recipes", false, run_generate,
      R"(Reads DIR/recipes/*.json and writes manifest.json and the files of every vector: the same bytes on
every machine. Files of vectors without a recipe are removed from the group folders. If the golden
model contradicts a recipe, nothing is written.

Example:
  hmlfc vectors generate)");
  add_output(generate, generated.output, generated.force, "DIR", "Write to this folder instead")
      ->required(false);
  add_threads(generate, generated.threads);

  generated.suite = "vectors";  // never the installed suite
  add_list(*app, task);
  const auto [steps, stepped] = add_suite_command(
      *app, task, "milestones", "List the milestones of a growing decoder", false, run_milestones,
      R"(Columns: name, number of vectors, what a decoder can do that passes them. Each vector belongs to the
first milestone at which all that it needs is there.
JSON: a list of {name, vectors, claim}.

Example:
  hmlfc vectors milestones)");
  add_frames(steps, stepped.frames);
  add_json(steps, stepped.json);
  add_suite_command(
      *app, task, "explain", "Say what one vector tests", true, run_explain,
      R"(Prints the mistake that the vector hunts, what a decoder must do, and the recipe.

Example:
  hmlfc vectors explain error/sign-mode-3)");
  const auto [show, shown] = add_suite_command(
      *app, task, "show", "Draw the views of one vector", true, run_show,
      R"(Writes all decoded views side by side. If the vector does not decode, its error is reported.

Example:
  hmlfc vectors show real/cards-main -o cards.png)");
  add_output(show, shown.output, shown.force, "FILE.png", "The PNG file to write");
  add_suite_command(
      *app, task, "inspect", "Dump one vector, every field with its clause", true, run_inspect,
      R"(Columns: address of the first bit as byte.bit, bits, the bytes that hold them, clause, name and
value. Values of bounded integer sequences appear where the sequence begins. The errors of a damaged
stream come last.

Example:
  hmlfc vectors inspect syntax/base-main)");
  add_suite_command(
      *app, task, "lint", "Check the suite's files without decoding them", false, run_lint,
      R"(Checks hashes and lengths of all files, stray files, names, conformance levels, headers, sections,
index and key image tables, traces and blocks files. Prints each problem; exit status 1 if there is one.

Example:
  hmlfc vectors lint)");
}

}  // namespace hmlfc::cli
