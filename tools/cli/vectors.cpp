// hmlfc vectors: the conformance suite.
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/vectors_suite.hpp"
#include "vectors/generate.hpp"

namespace hmlfc::cli {
namespace {

struct GenerateOptions {
  std::filesystem::path suite = "vectors";
  std::optional<std::filesystem::path> output;
  int threads = 0;
};

ExitCode run_generate(const GenerateOptions& options) {
  ProgressBar progress("Generating", "vectors");
  const auto files = value_or_throw(
      vectors::generate_suite(options.suite / "recipes", static_cast<unsigned>(options.threads),
                              progress.callback()),
      ExitCode::kInput);
  progress.clear();
  const auto folder = options.output.value_or(options.suite);
  make_output_folder(folder);
  value_or_throw(vectors::write_suite(files, folder), ExitCode::kOutput);
  uint64_t bytes = 0;
  for (const auto& [name, content] : files) bytes += content.size();
  print(fmt::format("{}: {} files, {} bytes\n", folder.string(), files.size(), grouped(bytes)));
  return ExitCode::kDone;
}

void add_generate(CLI::App& app, Task& task) {
  const auto options = std::make_shared<GenerateOptions>();
  CLI::App* generate = app.add_subcommand("generate", "Make the suite from its recipes");
  add_suite(*generate, options->suite);
  const auto reader = [options](const std::string& text) -> std::optional<std::string> {
    options->output = text;
    return std::nullopt;
  };
  add_value(*generate, "-o,--output", "DIR", "Write there and not into the suite", reader);
  add_threads(*generate, options->threads);
  generate->footer(
      R"(Reads DIR/recipes/*.json and writes manifest.json and the files of every vector: the same bytes on
every machine. Files of vectors without a recipe are removed from the folders of the groups. A recipe
that the golden model contradicts stops it before anything is written.

Example:
  hmlfc vectors generate)");
  generate->callback([&task, options] { task = [options] { return run_generate(*options); }; });
}

}  // namespace

void add_vectors(CLI::App& program, Task& task) {
  CLI::App* app = program.add_subcommand("vectors", "Make and examine the conformance suite");
  app->require_subcommand(1);
  add_generate(*app, task);
  add_vectors_list(*app, task);
  add_vectors_explain(*app, task);
  add_vectors_show(*app, task);
  add_vectors_inspect(*app, task);
  add_vectors_lint(*app, task);
}

}  // namespace hmlfc::cli
