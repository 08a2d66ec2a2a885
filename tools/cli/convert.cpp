// hmlfc convert: a light field from one form into another, sample for sample.
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/for_each_view.hpp"
#include "cli/view_source.hpp"
#include "io/image_files.hpp"
#include "io/light_field_files.hpp"
#include "io/view_mosaic.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

using io::Mosaic;
using io::MosaicLayout;

struct ConvertOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<io::GridShape> grid;
  std::optional<MosaicLayout> from;
  std::optional<MosaicLayout> to;
  std::optional<uint32_t> row;
  int threads = 0;
};

// The views in one picture.
class MosaicSource final : public ViewSource {
 public:
  MosaicSource(const std::filesystem::path& file, const Mosaic& mosaic) : mosaic_(mosaic) {
    io::ImageLosses losses;
    picture_ = value_or_throw(io::read_image(file, {}, &losses), ExitCode::kInput);
    note_losses(file, losses);
    shape_ = value_or_throw(io::mosaic_shape(file, picture_, mosaic), ExitCode::kInput);
  }

  const LightFieldShape& shape() const override { return shape_; }

  RgbImage view(ViewPos view) const override {
    return io::view_of_mosaic(picture_, mosaic_, view.row, view.col);
  }

 private:
  Mosaic mosaic_;
  RgbImage picture_;
  LightFieldShape shape_;
};

// One row of the views of another source.
class RowSource final : public ViewSource {
 public:
  RowSource(std::unique_ptr<ViewSource> all, uint32_t row)
      : all_(std::move(all)), row_(row), shape_(all_->shape()) {
    shape_.rows = 1;
  }

  const LightFieldShape& shape() const override { return shape_; }
  RgbImage view(ViewPos view) const override { return all_->view({row_, view.col}); }

 private:
  std::unique_ptr<ViewSource> all_;
  uint32_t row_;
  LightFieldShape shape_;
};

bool is_picture(const std::filesystem::path& file) {
  const std::string extension = io::lower_case_extension(file);
  return extension == ".png" || extension == ".ppm" || extension == ".jpg" || extension == ".jpeg";
}

std::unique_ptr<ViewSource> open_input(const ConvertOptions& options) {
  if (std::filesystem::is_directory(options.input) || !is_picture(options.input)) {
    if (options.from) throw Failure(ExitCode::kUsage, "--from is for an input that is a picture");
    return ViewSource::open(options.input, options.grid);
  }
  const auto quilt = io::parse_quilt_name(options.input);
  if (quilt && !options.from) return std::make_unique<MosaicSource>(options.input, quilt->mosaic);
  if (!options.from || !options.grid) {
    throw Failure(ExitCode::kUsage, options.input.string() +
                                        ": a picture needs --from and --grid, or the name of a "
                                        "quilt (_qsCxRaA)");
  }
  return std::make_unique<MosaicSource>(
      options.input, Mosaic{*options.from, options.grid->rows, options.grid->cols});
}

std::unique_ptr<ViewSource> chosen_row(std::unique_ptr<ViewSource> source,
                                       const ConvertOptions& options) {
  if (!options.row) return source;
  source->check_view({*options.row, 0});
  return std::make_unique<RowSource>(std::move(source), *options.row);
}

// The quilt that the output's name states, which must be that of the views.
Mosaic quilt_of(const std::filesystem::path& file, const LightFieldShape& shape) {
  if (shape.rows != 1) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: a quilt has one row of views, not {}; choose one by --row",
                              file.string(), shape.rows));
  }
  const auto quilt = *io::parse_quilt_name(file);
  const double aspect = static_cast<double>(shape.width) / shape.height;
  if (quilt.mosaic.grid().cols != shape.cols || std::abs(quilt.aspect - aspect) > 0.01) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: the views are {} of aspect {:.4g}; the name says {} x {} of "
                              "aspect {:.4g}",
                              file.string(), shape.cols, aspect, quilt.mosaic.cols,
                              quilt.mosaic.rows, quilt.aspect));
  }
  return quilt.mosaic;
}

Mosaic output_mosaic(const ConvertOptions& options, const LightFieldShape& shape) {
  if (options.to) return {*options.to, shape.rows, shape.cols};
  if (io::parse_quilt_name(options.output)) return quilt_of(options.output, shape);
  throw Failure(ExitCode::kUsage, options.output.string() +
                                      ": a picture needs --to, or the name of a quilt (_qsCxRaA)");
}

void write_picture(const ConvertOptions& options, const ViewSource& source,
                   const io::Progress& progress) {
  const LightFieldShape& shape = source.shape();
  const Mosaic mosaic = output_mosaic(options, shape);
  RgbImage picture =
      value_or_throw(io::empty_mosaic(options.output, shape, mosaic), ExitCode::kUsage);
  for_each_view({shape.rows, shape.cols}, options.threads, progress, [&](ViewPos view) {
    io::put_into_mosaic(picture, mosaic, view.row, view.col, source.view(view));
  });
  const bool ppm = io::lower_case_extension(options.output) == ".ppm";
  value_or_throw(
      ppm ? io::write_ppm(options.output, picture) : io::write_png(options.output, picture),
      ExitCode::kOutput);
}

void write_folder(const ConvertOptions& options, const ViewSource& source,
                  const io::Progress& progress) {
  if (options.to) throw Failure(ExitCode::kUsage, "--to is for an output that is a picture");
  const LightFieldShape& shape = source.shape();
  const auto produce = [&source](uint32_t row, uint32_t col) -> io::IoResult<RgbImage> {
    return source.view({row, col});
  };
  value_or_throw(io::save_views(options.output, {shape.rows, shape.cols}, produce,
                                static_cast<unsigned>(options.threads), progress),
                 ExitCode::kOutput);
}

ExitCode run_convert(const ConvertOptions& options) {
  const bool to_picture = is_picture(options.output);
  const std::string extension = io::lower_case_extension(options.output);
  if (extension == ".jpg" || extension == ".jpeg" || extension == ".hmlfc") {
    throw Failure(ExitCode::kUsage, options.output.string() +
                                        ": write a folder, .png or .ppm; hmlfc encode makes "
                                        "streams of folders");
  }
  if (to_picture) check_output_file(options.output);
  const auto source = chosen_row(open_input(options), options);
  terminal::ProgressBar progress("Converting", "views");
  (to_picture ? write_picture : write_folder)(options, *source, progress.callback());
  progress.clear();
  print(fmt::format("{}: {}\n", options.output.string(), describe(source->shape())));
  return ExitCode::kDone;
}

void add_layout(CLI::App& app, const std::string& name, std::optional<MosaicLayout>& target,
                const std::string& description) {
  add_choice(app, name, target,
             {{"tiles", MosaicLayout::kTiles}, {"lenslets", MosaicLayout::kLenslets}}, description);
}

}  // namespace

void add_convert(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "convert", "Turn a light field into another form, sample for sample",
      run_convert,
      R"(A form is a folder of views, an .hmlfc file (to read), or a picture of all views, PNG or PPM:
  quilt     by its name, NAME_qsCxRaA.png: C columns and R rows of tiles, from the bottom left, with
            the views of one row of cameras; A is the aspect of a view
  tiles     view R,C is the tile in row R and column C
  lenslets  pixel X,Y of view R,C is pixel X * COLS + C, Y * ROWS + R

Examples:
  hmlfc convert chess.hmlfc chess_qs3x3a1.33.png --row 4
  hmlfc convert chess.hmlfc lenslets.png --to lenslets
  hmlfc convert lenslets.png views --from lenslets --grid 9x9)");
  add_path(app, "INPUT", options.input, "Folder of views, .hmlfc file or picture");
  add_path(app, "OUTPUT", options.output, "Folder, .png or .ppm file to write");
  add_layout(app, "--from", options.from, "Layout of a picture that is read; needs --grid");
  add_layout(app, "--to", options.to, "Layout of a picture that is written");
  add_grid(app, options.grid);
  add_integer(app, "--row", options.row, 0, 4095, "Take this row of views alone");
  add_threads(app, options.threads);
}

}  // namespace hmlfc::cli
