// hmlfc picture: one picture of a light field, to be looked at.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/for_each_view.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/view_source.hpp"
#include "io/pictures.hpp"
#include "io/write_image.hpp"

namespace hmlfc::cli {
namespace {

struct PictureOptions {
  std::filesystem::path a;
  std::filesystem::path b;
  std::filesystem::path output;
  std::optional<io::GridShape> grid;
  std::optional<ViewPos> view;
  uint32_t max_width = 1600;
  int32_t gain = 8;
};

ExitCode write(const PictureOptions& options, const RgbImage& picture) {
  value_or_throw(io::write_png(options.output, picture), ExitCode::kOutput);
  print(
      fmt::format("{}: {} x {} pixels\n", options.output.string(), picture.width, picture.height));
  return ExitCode::kDone;
}

RgbImage view_of(const std::filesystem::path& path, const PictureOptions& options) {
  const auto source = ViewSource::open(path, options.grid);
  source->check_view(*options.view);
  return source->view(*options.view);
}

ExitCode run_view(const PictureOptions& options) {
  check_output_file(options.output);
  return write(options, view_of(options.a, options));
}

ExitCode run_sheet(const PictureOptions& options) {
  check_output_file(options.output);
  const auto source = ViewSource::open(options.a, options.grid);
  const LightFieldShape& shape = source->shape();
  LightField field(shape);
  ProgressBar progress("Reading", "views");
  for_each_view({shape.rows, shape.cols}, 0, progress.callback(),
                [&](ViewPos view) { field.set_view(view.row, view.col, source->view(view)); });
  progress.clear();
  return write(options, io::contact_sheet(field, options.max_width));
}

ExitCode run_difference(const PictureOptions& options) {
  check_output_file(options.output);
  const RgbImage a = view_of(options.a, options);
  const RgbImage b = view_of(options.b, options);
  return write(options,
               value_or_throw(io::difference_picture(a, b, options.gain), ExitCode::kInput));
}

void add_common(CLI::App& app, PictureOptions& options) {
  add_grid(app, options.grid);
  add_output(app, options.output, "FILE", "The PNG file to write");
}

void add_view_picture(CLI::App& picture, Task& task) {
  const auto options = std::make_shared<PictureOptions>();
  CLI::App* app = picture.add_subcommand("view", "One view");
  add_path(*app, "INPUT", options->a, "Folder of views or .hmlfc file");
  add_view(*app, options->view, "The view; counted from 0,0")->required();
  add_common(*app, *options);
  app->footer("Example:\n  hmlfc picture view chess.hmlfc --view 3,5 -o view.png");
  app->callback([&task, options] { task = [options] { return run_view(*options); }; });
}

void add_sheet_picture(CLI::App& picture, Task& task) {
  const auto options = std::make_shared<PictureOptions>();
  CLI::App* app = picture.add_subcommand("sheet", "All views side by side, reduced");
  add_path(*app, "INPUT", options->a, "Folder of views or .hmlfc file");
  add_integer(*app, "--max-width", options->max_width, 16, 65536, "Pixels of the sheet at most");
  add_common(*app, *options);
  app->footer("Example:\n  hmlfc picture sheet chess.hmlfc -o sheet.png");
  app->callback([&task, options] { task = [options] { return run_sheet(*options); }; });
}

void add_difference_picture(CLI::App& picture, Task& task) {
  const auto options = std::make_shared<PictureOptions>();
  CLI::App* app =
      picture.add_subcommand("difference", "Where one view of two light fields differs");
  add_path(*app, "A", options->a, "Folder of views or .hmlfc file");
  add_path(*app, "B", options->b, "Folder of views or .hmlfc file");
  add_view(*app, options->view, "The view; counted from 0,0")->required();
  add_integer(*app, "--gain", options->gain, 1, 4096, "Amplification of the difference");
  add_common(*app, *options);
  app->footer(
      R"(A sample of the picture is 128 + gain * (a - b), clamped to [0, 255]: grey is equal.

Example:
  hmlfc picture difference views chess.hmlfc --view 3,5 -o difference.png)");
  app->callback([&task, options] { task = [options] { return run_difference(*options); }; });
}

}  // namespace

void add_picture(CLI::App& program, Task& task) {
  CLI::App* app =
      program.add_subcommand("picture", "Make a PNG: a view, a contact sheet, a difference");
  app->require_subcommand(1);
  app->footer("Example:\n  hmlfc picture sheet chess.hmlfc -o sheet.png");
  add_view_picture(*app, task);
  add_sheet_picture(*app, task);
  add_difference_picture(*app, task);
}

}  // namespace hmlfc::cli
