// hmlfc picture: an image of a light field to look at.
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/for_each_view.hpp"
#include "cli/view_source.hpp"
#include "io/image_files.hpp"
#include "io/pictures.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

struct PictureOptions {
  std::filesystem::path a;
  std::filesystem::path b;
  std::filesystem::path output;
  bool force = false;
  io::ViewNaming naming;
  std::optional<ViewPos> view;
  uint32_t max_width = 1600;
  int32_t gain = 8;
};

constexpr const char* kPictureSign = "hmlfc picture";

OutputFile output_of(const PictureOptions& options) {
  return picture_file(options.output, {kPictureSign, options.force, {options.a, options.b}});
}

ExitCode write(const PictureOptions& options, const OutputFile& output, const RgbImage& picture) {
  value_or_throw(io::write_png(output.path(), picture, kPictureSign), ExitCode::kOutput);
  output.finish();
  print(
      fmt::format("{}: {} x {} pixels\n", options.output.string(), picture.width, picture.height));
  return ExitCode::kDone;
}

RgbImage view_of(const std::filesystem::path& path, const PictureOptions& options) {
  const auto source = ViewSource::open(path, options.naming);
  source->check_view(*options.view);
  return source->view(*options.view);
}

ExitCode run_view(const PictureOptions& options) {
  const OutputFile output = output_of(options);
  return write(options, output, view_of(options.a, options));
}

ExitCode run_sheet(const PictureOptions& options) {
  const OutputFile output = output_of(options);
  const auto source = ViewSource::open(options.a, options.naming);
  const LightFieldShape& shape = source->shape();
  auto sheet = value_or_throw(io::ContactSheet::make(shape, options.max_width), ExitCode::kUsage);
  terminal::ProgressBar progress("Reading", "views");
  for_each_view({shape.rows, shape.cols}, 0, progress.callback(),
                [&](ViewPos view) { sheet.draw(view.row, view.col, source->view(view)); });
  progress.clear();
  return write(options, output, sheet.image());
}

ExitCode run_difference(const PictureOptions& options) {
  const OutputFile output = output_of(options);
  const RgbImage a = view_of(options.a, options);
  const RgbImage b = view_of(options.b, options);
  return write(options, output,
               value_or_throw(io::difference_picture(a, b, options.gain), ExitCode::kInput));
}

void add_common(CLI::App& app, PictureOptions& options) {
  add_naming(app, options.naming);
  add_output(app, options.output, options.force, "FILE.png", "The PNG file to write");
}

}  // namespace

void add_picture(CLI::App& program, Task& task) {
  CLI::App* picture =
      program.add_subcommand("picture", "Make a PNG: a view, a contact sheet or a difference");
  picture->require_subcommand(1);
  picture->footer("Example:\n  hmlfc picture sheet chess.hmlfc -o sheet.png");
  const char* input = "Folder of views or .hmlfc file";

  const auto [view, one] =
      add_command(*picture, task, "view", "One view", run_view,
                  "Example:\n  hmlfc picture view chess.hmlfc --view 3,5 -o view.png");
  add_path(view, "INPUT", one.a, input);
  add_view(view, one.view, "The view; counted from 0,0")->required();
  add_common(view, one);

  const auto [sheet, all] =
      add_command(*picture, task, "sheet", "All views side by side, reduced", run_sheet,
                  "Example:\n  hmlfc picture sheet chess.hmlfc -o sheet.png");
  add_path(sheet, "INPUT", all.a, input);
  add_integer(sheet, "--max-width", all.max_width, 16, 65536, "Maximum width of the sheet, pixels");
  add_common(sheet, all);

  const auto [difference, two] = add_command(
      *picture, task, "difference", "Where one view of two light fields differs", run_difference,
      R"(Each sample of the image is 128 + gain * (a - b), clamped to [0, 255]: grey means equal.

Example:
  hmlfc picture difference views chess.hmlfc --view 3,5 -o difference.png)");
  add_path(difference, "A", two.a, input);
  add_path(difference, "B", two.b, input);
  add_view(difference, two.view, "The view; counted from 0,0")->required();
  add_integer(difference, "--gain", two.gain, 1, 4096, "Amplification of the difference");
  add_common(difference, two);
}

}  // namespace hmlfc::cli
