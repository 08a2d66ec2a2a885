// hmlfc info: what a stream is and what its bytes are spent on.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

#include "cli/arguments.hpp"
#include "cli/rig_options.hpp"
#include "cli/stream_report.hpp"
#include "cli/view_source.hpp"
#include "io/disparity_range.hpp"

namespace hmlfc::cli {
namespace {

struct InfoOptions {
  std::filesystem::path file;
  bool json = false;
  bool rig = false;
};

std::string tools_text(const StreamHeader& header) {
  const auto tools = io::tools_of(header);
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

std::string geometry_text(const StreamFile& file) {
  const auto range = file.value(io::disparity_range(file.decoder(), file.size()));
  return fmt::format("Geometry      {}\n", describe(range));
}

ExitCode run_info(const InfoOptions& options) {
  const StreamFile file(options.file);
  if (options.rig) {
    print(rig_text_of(file) + "\n");
    return ExitCode::kDone;
  }
  if (options.json) {
    print_json(file.value(io::info_json(file.decoder(), file.source())));
    check_rig(file);
    return ExitCode::kDone;
  }
  const io::StreamReport report = report_on(file);
  const StreamHeader& header = report.header;
  print(fmt::format("Light field   {}\nCoding        {}\n", describe(shape_of(header)),
                    describe_coding(header)) +
        tools_text(header) + size_text(report) + tree_text(header) +
        states_text(report.statistics) + geometry_text(file) + rig_line(file));
  check_rig(file);
  return ExitCode::kDone;
}

}  // namespace

void add_info(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "info", "Show what a stream is and what its bytes are spent on", run_info,
      R"(bpp is 8 * bytes / (rows * cols * width * height) of the whole file. ratio is the raw size, 3 * depth
bits per pixel, divided by the file size. sections are in bytes and add up to the file size: motion and
residual are rounded down from bits, and index takes the rest.

JSON keys: bytes, bpp, ratio, rows, cols, width, height, profile, method, sections{header, index,
motion, residual, top, other (the rig)}, depth, chroma, block, window, cluster, tree_height, tools
(feature flags), levels (from the top; keys: rows and columns of key images, of levels of at most 4096
images), states (block counts), disparity{known, blocks (counts over all views), least, greatest (pixels
a column; negative is nearer; absent where none is known; null: not counted, as the header asks for far
more blocks than the file has bytes)}, rig (as --rig prints it, null without one,
{error} where it cannot be read, with exit status 4).

Examples:
  hmlfc info chess.hmlfc
  hmlfc info posed.hmlfc --rig)");
  add_stream(app, options.file);
  auto* json = add_json(app, options.json);
  app.add_flag("--rig", options.rig, "Print where the cameras stand, for encode --rig")
      ->excludes(json);
}

}  // namespace hmlfc::cli
