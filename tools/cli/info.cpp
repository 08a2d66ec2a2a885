// hmlfc info: what a stream is and where its bytes go.
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <hmlfc/stream_info.hpp>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/stream_report.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {
namespace {

struct InfoOptions {
  std::filesystem::path file;
  bool json = false;
};

std::string tools_text(const StreamHeader& header) {
  const auto tools = tools_of(header);
  return tools.empty() ? "" : fmt::format("Tools         {}\n", fmt::join(tools, ", "));
}

std::string tree_text(const StreamHeader& header) {
  std::string text = "Tree\n";
  for (int level = header.tree_height; level >= 0; --level) {
    const LevelInfo shape = level_info(header, level);
    text += fmt::format("  level {:<2} {:>5} x {:<5} images", level, shape.rows, shape.cols);
    const bool motion = shape.ref_rows > 1 || shape.ref_cols > 1;
    if (motion) {
      text += fmt::format(", one reference per {} x {}", shape.ref_rows, shape.ref_cols);
    } else {
      text += ", no motion";
    }
    if (shape.key_images > 0) {
      text += fmt::format(", {} key image{}", shape.key_images, shape.key_images == 1 ? "" : "s");
    }
    text += "\n";
  }
  return text;
}

std::string states_text(const StreamStatistics& statistics) {
  uint64_t all = 0;
  for (const uint64_t count : statistics.states) all += count;
  std::string text = "Blocks\n";
  for (size_t state = 0; state < statistics.states.size(); ++state) {
    const uint64_t count = statistics.states[state];
    const double share = all == 0 ? 0 : static_cast<double>(count) / static_cast<double>(all);
    text += fmt::format("  {:<19} {:>14} {:5.1f} %\n", state_name(static_cast<BlockState>(state)),
                        grouped(count), 100 * share);
  }
  return text;
}

ExitCode run_info(const InfoOptions& options) {
  const StreamFile file(options.file);
  const StreamReport report = report_on(file);
  if (options.json) {
    Json json = report_json(report);
    add_structure(report, json);
    print_json(json);
    return ExitCode::kDone;
  }
  const StreamHeader& header = report.header;
  const LightFieldShape shape{header.rows, header.cols, header.width, header.height, header.depth};
  print(fmt::format("Light field   {}\nCoding        {}\n", describe(shape),
                    describe_coding(header)) +
        tools_text(header) + size_text(report) + tree_text(header) +
        states_text(report.statistics));
  return ExitCode::kDone;
}

}  // namespace

void add_info(CLI::App& program, Task& task) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* app = program.add_subcommand("info", "Show what a stream is and where its bytes go");
  add_path(*app, "FILE", options->file, "An .hmlfc file");
  app->add_flag("--json", options->json, "Print JSON");
  app->footer(
      R"(bpp is 8 * bytes / (rows * cols * width * height), the whole file counted. ratio is the raw size,
3 * depth bits a pixel, divided by the file's. sections are bytes and add up to the file: motion and
residual are rounded down from bits, index is the rest.

JSON keys: bytes, bpp, ratio, rows, cols, width, height, profile, method, sections{header, index,
motion, residual, top, other}; then depth, chroma, block, window, cluster, tree_height, tools (feature
flags), levels (from the top), states (numbers of blocks).

Example:
  hmlfc info chess.hmlfc)");
  app->callback([&task, options] { task = [options] { return run_info(*options); }; });
}

}  // namespace hmlfc::cli
