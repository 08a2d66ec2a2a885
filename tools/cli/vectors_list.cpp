// hmlfc vectors list and explain: what the suite holds.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/output.hpp"
#include "cli/vectors_suite.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::cli {
namespace {

struct ListOptions {
  std::filesystem::path suite = "vectors";
  std::string group;
  std::string clause;
  bool json = false;
};

struct ExplainOptions {
  std::filesystem::path suite = "vectors";
  std::string id;
};

std::string expectation(const vectors::Expectation& expect) {
  if (expect.outcome == vectors::Outcome::kOk) return "ok";
  return fmt::format("{} {}", vectors::outcome_name(expect.outcome), error_name(expect.error));
}

bool is_chosen(const vectors::Vector& vector, const ListOptions& options) {
  if (!options.group.empty() && vector.group != options.group) return false;
  if (options.clause.empty()) return true;
  return std::find(vector.clauses.begin(), vector.clauses.end(), options.clause) !=
         vector.clauses.end();
}

ExitCode run_list(const ListOptions& options) {
  const vectors::Manifest manifest = manifest_of(options.suite);
  Json rows = Json::array();
  std::string text;
  size_t count = 0;
  for (const vectors::Vector& vector : manifest.vectors) {
    if (!is_chosen(vector, options)) continue;
    ++count;
    rows.push_back({{"id", vector.id},
                    {"profile", profile_name(vector.profile)},
                    {"level", vector.level},
                    {"bytes", vector.input.bytes},
                    {"outcome", vectors::outcome_name(vector.expect.outcome)}});
    text += fmt::format("{:44} {:9} {} {:>9}  {}\n", vector.id, profile_name(vector.profile),
                        vector.level, grouped(vector.input.bytes), expectation(vector.expect));
  }
  if (options.json) {
    print_json(rows);
  } else {
    print(fmt::format("{}{} of {} vectors, version {}\n", text, count, manifest.vectors.size(),
                      manifest.vectors_version));
  }
  return ExitCode::kDone;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

ExitCode run_explain(const ExplainOptions& options) {
  const vectors::Manifest manifest = manifest_of(options.suite);
  const vectors::Vector& vector = vector_of(manifest, options.id);
  const vectors::Expectation& expect = vector.expect;
  std::string text = fmt::format(
      "{}\n  {}\n  clauses  {}\n  flags    {}\n  stream   {}, {} bytes, profile {}, level {}\n",
      vector.id, vector.comment, joined(vector.clauses), joined(vector.flags), vector.input.file,
      vector.input.bytes, profile_name(vector.profile), vector.level);
  text += "  expected " + expectation(expect);
  if (expect.outcome != vectors::Outcome::kOk) {
    text +=
        fmt::format(" at byte {}, when {}", expect.offset,
                    expect.operation == vectors::Operation::kOpen ? "the stream is opened"
                                                                  : "these blocks are decoded:");
  }
  text += "\n";
  for (const BlockAddress& block : expect.blocks) {
    text += fmt::format("           view {},{} plane {} block {},{}\n", block.view.row,
                        block.view.col, plane_name(block.plane), block.bx, block.by);
  }
  if (vector.output) {
    text += fmt::format("  output   {} x {} views of {} x {}, depth {}, SHA-256 {}\n",
                        vector.output->rows, vector.output->cols, vector.output->width,
                        vector.output->height, vector.output->depth, vector.output->sha256);
  }
  if (vector.trace) {
    text += fmt::format("  trace    {}, {}\n", vector.trace->lines.file, vector.trace->hex.file);
  }
  try {
    const auto recipes = vectors::read_recipes(options.suite / "recipes");
    text += "  recipe   " + recipes.at(vector.id).stream.dump() + "\n";
  } catch (const std::exception& error) {
    throw Failure(ExitCode::kInput, error.what());
  }
  print(text);
  return ExitCode::kDone;
}

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& type,
                      std::string& target, const std::string& description) {
  return add_value(app, name, type, description,
                   [&target](const std::string& text) -> std::optional<std::string> {
                     target = text;
                     return std::nullopt;
                   });
}

}  // namespace

void add_vectors_list(CLI::App& app, Task& task) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* list = app.add_subcommand("list", "List the vectors");
  add_suite(*list, options->suite);
  add_text(*list, "--group", "NAME", options->group, "Those of one group alone");
  add_text(*list, "--clause", "CLAUSE", options->clause, "Those that exercise one clause alone");
  list->add_flag("--json", options->json, "Print JSON");
  list->footer(
      R"(Columns: id, profile, level, bytes of the stream, expected outcome.
JSON: a list of {id, profile, level, bytes, outcome}; manifest.json has all there is.

Example:
  hmlfc vectors list --clause BISE-10)");
  list->callback([&task, options] { task = [options] { return run_list(*options); }; });
}

void add_vectors_explain(CLI::App& app, Task& task) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* explain = app.add_subcommand("explain", "Say what one vector tests");
  add_text(*explain, "ID", "ID", options->id, "The vector, as group/name")->required();
  add_suite(*explain, options->suite);
  explain->footer(
      R"(Prints what the vector hunts, what is expected of a decoder, and the recipe that it is made from.

Example:
  hmlfc vectors explain error/sign-mode-3)");
  explain->callback([&task, options] { task = [options] { return run_explain(*options); }; });
}

}  // namespace hmlfc::cli
