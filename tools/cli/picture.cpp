// hmlfc picture: an image of a light field to look at.
#include <algorithm>
#include <filesystem>
#include <optional>

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
  std::optional<uint32_t> row, col, x, y;
  uint32_t thickness = 8;
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

RgbImage view_of(const std::filesystem::path& path, const PictureOptions& options,
                 const std::filesystem::path& other = {}) {
  const auto source = ViewSource::open(path, options.naming, other);
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
  const RgbImage a = view_of(options.a, options, options.b);
  const RgbImage b = view_of(options.b, options, options.a);
  return write(options, output,
               value_or_throw(io::difference_picture(a, b, options.gain), ExitCode::kInput));
}

void check_place(const char* name, uint32_t value, uint32_t count) {
  if (value < count) return;
  throw Failure(ExitCode::kUsage,
                fmt::format("{} {} does not exist: 0 to {}", name, value, count - 1));
}

// Pixel row y of all views of a row, one below the other; or pixel column x of all of a column,
// side by side.
ExitCode run_epipolar(const PictureOptions& options) {
  const OutputFile output = output_of(options);
  if (!options.row && !options.col) {
    throw Failure(ExitCode::kUsage, "--row and --y are missing, or --col and --x");
  }
  const auto source = ViewSource::open(options.a, options.naming);
  const LightFieldShape& shape = source->shape();
  const bool of_row = options.row.has_value();
  if (of_row) {
    check_place("--row", *options.row, shape.rows);
    check_place("--y", *options.y, shape.height);
  } else {
    check_place("--col", *options.col, shape.cols);
    check_place("--x", *options.x, shape.width);
  }
  const uint32_t views = of_row ? shape.cols : shape.rows;
  const uint32_t length = of_row ? shape.width : shape.height;
  const uint32_t across = views * options.thickness;
  RgbImage picture{of_row ? length : across, of_row ? across : length, shape.depth, {}};
  picture.samples.resize(size_t{3} * length * across);
  for_each_view({1, views}, 0, {}, [&](ViewPos at) {
    const RgbImage view =
        source->view(of_row ? ViewPos{*options.row, at.col} : ViewPos{at.col, *options.col});
    for (size_t i = 0; i < length; ++i) {
      const auto from = view.samples.begin() +
                        static_cast<ptrdiff_t>(3 * (of_row ? *options.y * size_t{view.width} + i
                                                           : i * view.width + *options.x));
      for (size_t k = size_t{at.col} * options.thickness; k < (at.col + 1) * options.thickness;
           ++k) {
        const size_t to = of_row ? k * picture.width + i : i * picture.width + k;
        std::copy_n(from, 3, picture.samples.begin() + static_cast<ptrdiff_t>(3 * to));
      }
    }
  });
  return write(options, output, picture);
}

void add_common(CLI::App& app, PictureOptions& options) {
  add_naming(app, options.naming);
  add_output(app, options.output, options.force, "FILE.png", "The PNG file to write");
}

void add_epipolar(CLI::App& picture, Task& task) {
  const auto [app, options] = add_command(
      picture, task, "epipolar", "One line of pixels in all views of a row or a column",
      run_epipolar,
      R"(With --row R --y Y the picture has pixel row Y of each view of row R, from column 0 down; with --col C
--x X it has pixel column X of each view of column C, from row 0 to the right. A point of the scene is
a straight line in it, whose slope is its disparity. --thickness 1 keeps each line once.

Example:
  hmlfc picture epipolar chess.hmlfc --row 4 --y 30 -o epipolar.png)");
  add_path(app, "INPUT", options.a, "Folder of views or .hmlfc file");
  CLI::Option* row = add_integer(app, "--row", options.row, 0, 4095, "Row of views");
  CLI::Option* y = add_integer(app, "--y", options.y, 0, 65535, "Pixel row in each of them");
  CLI::Option* col = add_integer(app, "--col", options.col, 0, 4095, "Column of views");
  CLI::Option* x = add_integer(app, "--x", options.x, 0, 65535, "Pixel column in each of them");
  row->needs(y)->excludes(col);
  y->needs(row);
  col->needs(x);
  x->needs(col);
  add_integer(app, "--thickness", options.thickness, 1, 64, "Pixels that each view takes across");
  add_common(app, options);
}

}  // namespace

void add_picture(CLI::App& program, Task& task) {
  CLI::App* picture =
      program.add_subcommand("picture", "Make a PNG: views, differences, epipolar pictures");
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

  add_epipolar(*picture, task);
}

}  // namespace hmlfc::cli
