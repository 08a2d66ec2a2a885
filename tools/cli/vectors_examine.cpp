// hmlfc vectors show, inspect and lint: the suite's files.
#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/output.hpp"
#include "cli/stream_file.hpp"
#include "cli/vectors_suite.hpp"
#include "io/mapped_file.hpp"
#include "io/pictures.hpp"
#include "io/write_image.hpp"
#include "vectors/annotate.hpp"
#include "vectors/lint.hpp"

namespace hmlfc::cli {
namespace {

struct ExamineOptions {
  std::filesystem::path suite = "vectors";
  std::string id;
  std::filesystem::path output;
};

constexpr uint32_t kSheetWidth = 1024;

ExitCode run_show(const ExamineOptions& options) {
  check_output_file(options.output);
  const vectors::Manifest manifest = manifest_of(options.suite);
  const StreamFile file(options.suite / vector_of(manifest, options.id).input.file);
  const StreamHeader& header = file.header();
  LightField views({header.rows, header.cols, header.width, header.height, header.depth});
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      views.set_view(row, col, value_or_throw(file.decoder().decode_view({row, col}), file.path()));
    }
  }
  const RgbImage sheet = io::contact_sheet(views, kSheetWidth);
  value_or_throw(io::write_png(options.output, sheet), ExitCode::kOutput);
  print(fmt::format("{}: {} x {} views\n", options.output.string(), header.rows, header.cols));
  return ExitCode::kDone;
}

ExitCode run_inspect(const ExamineOptions& options) {
  const vectors::Manifest manifest = manifest_of(options.suite);
  const auto path = options.suite / vector_of(manifest, options.id).input.file;
  const auto file = value_or_throw(io::MappedFile::open(path), ExitCode::kInput);
  print(vectors::annotated_dump(file.bytes()));
  return ExitCode::kDone;
}

ExitCode run_lint(const ExamineOptions& options) {
  const vectors::Manifest manifest = manifest_of(options.suite);
  const auto found = vectors::lint_suite(options.suite, manifest);
  for (const std::string& line : found) print(line + "\n");
  if (!found.empty()) return ExitCode::kDifferent;
  print(fmt::format("{} vectors: nothing to complain about\n", manifest.vectors.size()));
  return ExitCode::kDone;
}

void add_id(CLI::App& app, std::string& id) {
  const auto reader = [&id](const std::string& text) -> std::optional<std::string> {
    id = text;
    return std::nullopt;
  };
  add_value(app, "ID", "ID", "The vector, as group/name", reader)->required();
}

}  // namespace

void add_suite(CLI::App& app, std::filesystem::path& suite) {
  const auto reader = [&suite](const std::string& text) -> std::optional<std::string> {
    suite = text;
    return std::nullopt;
  };
  add_value(app, "--suite", "DIR", "Folder of the suite", reader)->default_str(suite.string());
}

vectors::Manifest manifest_of(const std::filesystem::path& suite) {
  return value_or_throw(vectors::read_manifest(suite), ExitCode::kInput);
}

const vectors::Vector& vector_of(const vectors::Manifest& manifest, const std::string& id) {
  for (const vectors::Vector& vector : manifest.vectors) {
    if (vector.id == id) return vector;
  }
  throw Failure(ExitCode::kUsage, "there is no vector " + id + "; hmlfc vectors list names them");
}

void add_vectors_show(CLI::App& app, Task& task) {
  const auto options = std::make_shared<ExamineOptions>();
  CLI::App* show = app.add_subcommand("show", "Draw the views of one vector");
  add_id(*show, options->id);
  add_suite(*show, options->suite);
  add_output(*show, options->output, "FILE", "The PNG to write");
  show->footer(
      R"(Writes all decoded views side by side. A vector that does not decode gives its error.

Example:
  hmlfc vectors show real/cards-main -o cards.png)");
  show->callback([&task, options] { task = [options] { return run_show(*options); }; });
}

void add_vectors_inspect(CLI::App& app, Task& task) {
  const auto options = std::make_shared<ExamineOptions>();
  CLI::App* inspect = app.add_subcommand("inspect", "Dump one vector, every field with its clause");
  add_id(*inspect, options->id);
  add_suite(*inspect, options->suite);
  inspect->footer(
      R"(Columns: address of the first bit as byte.bit, bits, the bytes that hold them, clause, name and
value. Values of bounded integer sequences stand where the sequence begins. Of a damaged stream the
errors come last.

Example:
  hmlfc vectors inspect syntax/base-main)");
  inspect->callback([&task, options] { task = [options] { return run_inspect(*options); }; });
}

void add_vectors_lint(CLI::App& app, Task& task) {
  const auto options = std::make_shared<ExamineOptions>();
  CLI::App* lint = app.add_subcommand("lint", "Check the suite's files without decoding them");
  add_suite(*lint, options->suite);
  lint->footer(
      R"(Sums and lengths of all files, stray files, names, levels, headers, sections, index and key image
tables, traces and blocks files. Prints each complaint; exit status 1 if there is one.

Example:
  hmlfc vectors lint)");
  lint->callback([&task, options] { task = [options] { return run_lint(*options); }; });
}

}  // namespace hmlfc::cli
