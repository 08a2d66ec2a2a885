// hmlfc compare: the differences of two light fields.
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"
#include "cli/comparison.hpp"
#include "cli/disparity_error.hpp"
#include "cli/view_source.hpp"
#include "io/image_files.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

struct CompareOptions {
  std::filesystem::path a;
  std::filesystem::path b;
  io::ViewNaming naming;
  ComparedPart part;
  bool json = false;
};

char channel_name(uint32_t channel) { return "RGB"[channel]; }

Json difference_json(const std::optional<Difference>& difference) {
  if (!difference) return nullptr;
  return {{"row", difference->view.row},
          {"col", difference->view.col},
          {"x", difference->x},
          {"y", difference->y},
          {"channel", std::string(1, channel_name(difference->channel))},
          {"a", difference->a},
          {"b", difference->b}};
}

Json comparison_json(const Comparison& comparison) {
  return {{"psnr_rgb", psnr_json(comparison.quality.psnr_rgb)},
          {"psnr_y", psnr_json(comparison.quality.psnr_y)},
          {"psnr_rgb_min", psnr_json(comparison.psnr_rgb_min)},
          {"max_abs_error", comparison.quality.max_abs_error},
          {"identical", comparison.identical()},
          {"first_difference", difference_json(comparison.first_difference)}};
}

std::string comparison_text(const Comparison& comparison, const LightFieldShape& shape) {
  const std::string head = fmt::format("Light fields      {}\n", describe(shape));
  if (comparison.identical()) return head + "Identical\n";
  const Difference& first = *comparison.first_difference;
  return head + fmt::format(
                    "PSNR RGB          {}\n"
                    "PSNR Y            {}\n"
                    "PSNR RGB, worst   {}, view {},{}\n"
                    "Largest error     {}\n"
                    "First difference  view {},{} x {} y {} channel {}: {} versus {}\n",
                    psnr_text(comparison.quality.psnr_rgb), psnr_text(comparison.quality.psnr_y),
                    psnr_text(comparison.psnr_rgb_min), comparison.worst_view.row,
                    comparison.worst_view.col, comparison.quality.max_abs_error, first.view.row,
                    first.view.col, first.x, first.y, channel_name(first.channel), first.a,
                    first.b);
}

ExitCode run_compare(const CompareOptions& options) {
  const auto is_map = [](const auto& path) { return io::lower_case_extension(path) == ".pfm"; };
  if (is_map(options.a) != is_map(options.b)) {
    throw Failure(ExitCode::kUsage,
                  "a map is compared with a map; hmlfc disparity writes the *.pfm of a stream");
  }
  if (is_map(options.a)) {
    const std::string why = "a map is of one view; leave it out";
    refuse_naming(options.naming, why);
    refuse_given({{"--view", options.part.view.has_value()}}, why);
    return compare_maps(options.a, options.b, options.part.rect, options.json);
  }
  io::ViewNaming naming = options.naming;
  const auto a = ViewSource::open(options.a, naming, options.b);
  naming.pattern_is_for_others = true;
  const auto b = ViewSource::open(options.b, naming, options.a);
  terminal::ProgressBar progress("Comparing", "views");
  const Comparison comparison = compare(*a, *b, options.part, progress.callback());
  progress.clear();
  print_result(options.json, comparison_json(comparison), comparison_text(comparison, a->shape()));
  return comparison.identical() ? ExitCode::kDone : ExitCode::kDifferent;
}

}  // namespace

void add_compare(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "compare", "Compare two light fields, or two maps of disparities", run_compare,
      R"(Exit status: 0 if they are identical, 1 if samples differ, 3 if grids, sizes or depths differ.

PSNR is computed from the mean squared error over all compared pixels, psnr_rgb_min over those of the
worst view. "inf" (a string in JSON) means no difference. first_difference is the first sample that
differs, in row order of views, then of pixels: row, col, x, y, channel, a, b; null if there is none.
x and y count from the corner of the view, with --rect too.

JSON keys: psnr_rgb, psnr_y, psnr_rgb_min, max_abs_error, identical, first_difference.

Of two *.pfm files it tells the mean and the largest error, 100 times the mean squared error, and
BadPix, the percentage of pixels that are off by more than 0.07, 0.03 and 0.01, as the HCI 4D Light
Field Benchmark does, which leaves out 15 pixels on each side: --rect 15,15,482,482. What is not finite
is unknown. JSON keys: mean_abs_error, max_abs_error, mse_x100, badpix, pixels, unknown, identical.

Examples:
  hmlfc compare views chess.hmlfc --json
  hmlfc compare map.pfm gt_disp_lowres.pfm --rect 15,15,482,482)");
  add_path(app, "A", options.a, "Folder of views, .hmlfc file or map *.pfm");
  add_path(app, "B", options.b, "Folder of views, .hmlfc file or map *.pfm");
  add_naming(app, options.naming);
  add_view(app, options.part.view, "Only this view; counted from 0,0");
  add_rect(app, options.part.rect);
  add_json(app, options.json);
}

}  // namespace hmlfc::cli
