// hmlfc compare: how two light fields differ.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/light_field_comparison.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {
namespace {

struct CompareOptions {
  std::filesystem::path a;
  std::filesystem::path b;
  std::optional<io::GridShape> grid;
  bool json = false;
};

char channel_name(uint32_t channel) { return "RGB"[channel]; }

Json difference_json(const std::optional<Difference>& difference) {
  if (!difference) return nullptr;
  Json json;
  json["row"] = difference->view.row;
  json["col"] = difference->view.col;
  json["x"] = difference->x;
  json["y"] = difference->y;
  json["channel"] = std::string(1, channel_name(difference->channel));
  json["a"] = difference->a;
  json["b"] = difference->b;
  return json;
}

void print_comparison_json(const Comparison& comparison) {
  Json json;
  json["psnr_rgb"] = psnr_json(comparison.quality.psnr_rgb);
  json["psnr_y"] = psnr_json(comparison.quality.psnr_y);
  json["psnr_rgb_min"] = psnr_json(comparison.psnr_rgb_min);
  json["max_abs_error"] = comparison.quality.max_abs_error;
  json["identical"] = comparison.identical();
  json["first_difference"] = difference_json(comparison.first_difference);
  print_json(json);
}

void print_comparison_text(const Comparison& comparison, const LightFieldShape& shape) {
  print(fmt::format("Light fields      {}\n", describe(shape)));
  if (comparison.identical()) return print("Identical\n");
  const Difference& first = *comparison.first_difference;
  print(
      fmt::format("PSNR RGB          {}\n"
                  "PSNR Y            {}\n"
                  "PSNR RGB at worst {}, view {},{}\n"
                  "Largest error     {}\n"
                  "First difference  view {},{} x {} y {} channel {}: {} against {}\n",
                  psnr_text(comparison.quality.psnr_rgb), psnr_text(comparison.quality.psnr_y),
                  psnr_text(comparison.psnr_rgb_min), comparison.worst_view.row,
                  comparison.worst_view.col, comparison.quality.max_abs_error, first.view.row,
                  first.view.col, first.x, first.y, channel_name(first.channel), first.a, first.b));
}

ExitCode run_compare(const CompareOptions& options) {
  const auto a = ViewSource::open(options.a, options.grid);
  const auto b = ViewSource::open(options.b, options.grid);
  ProgressBar progress("Comparing", "views");
  const Comparison comparison = compare(*a, *b, progress.callback());
  progress.clear();
  if (options.json) {
    print_comparison_json(comparison);
  } else {
    print_comparison_text(comparison, a->shape());
  }
  return comparison.identical() ? ExitCode::kDone : ExitCode::kDifferent;
}

}  // namespace

void add_compare(CLI::App& program, Task& task) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* app = program.add_subcommand("compare", "Compare two light fields");
  add_path(*app, "A", options->a, "Folder of views or .hmlfc file");
  add_path(*app, "B", options->b, "Folder of views or .hmlfc file");
  add_grid(*app, options->grid);
  app->add_flag("--json", options->json, "Print JSON");
  app->footer(
      R"(Exit status 0: identical, 1: they differ, 3: their grids, sizes or depths differ.

PSNR is that of the mean squared error over all views, psnr_rgb_min that of the worst view; "inf" (a
string in JSON, too) means that nothing differs. first_difference is the first sample that differs,
views and pixels row by row: row, col, x, y, channel, a, b; or null.

JSON keys: psnr_rgb, psnr_y, psnr_rgb_min, max_abs_error, identical, first_difference.

Example:
  hmlfc compare views chess.hmlfc --json)");
  app->callback([&task, options] { task = [options] { return run_compare(*options); }; });
}

}  // namespace hmlfc::cli
