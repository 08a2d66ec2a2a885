// hmlfc convert: a light field from one form into another, sample for sample.
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/convert_forms.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

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

std::unique_ptr<ViewSource> chosen_row(std::unique_ptr<ViewSource> source,
                                       const ConvertOptions& options) {
  if (!options.row) return source;
  source->check_view({*options.row, 0});
  return std::make_unique<RowSource>(std::move(source), *options.row);
}

ExitCode run_convert(const ConvertOptions& options) {
  check_output(options);
  const ThreadLimit limit(options.threads);
  const auto source = chosen_row(open_input(options), options);
  terminal::ProgressBar progress("Converting", "views");
  write_output(options, *source, progress.callback());
  progress.clear();
  print(fmt::format("{}: {}\n", options.output.string(), describe(source->shape())));
  return ExitCode::kDone;
}

void add_form(CLI::App& app, const std::string& name, std::optional<Form>& target,
              const std::string& description) {
  add_choice(app, name, target,
             {{"tiles", Form::kTiles}, {"lenslets", Form::kLenslets}, {"pleno", Form::kPleno}},
             description);
}

}  // namespace

void add_convert(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "convert", "Turn a light field into another form, sample for sample",
      run_convert,
      R"(A form is a folder of views, an .hmlfc file (written without loss, with no rig), a video, or a
picture of all views, PNG or PPM:
  quilt     by its name, NAME_qsCxRaA.png: C columns and R rows of tiles, from the bottom left, with
            the views of one row of cameras; A is the aspect of a view
  tiles     view R,C is the tile in row R and column C
  lenslets  pixel X,Y of view R,C is pixel X * COLS + C, Y * ROWS + R

--from pleno and --to pleno are for folders whose files say the column first, CCC_RRR.ppm, as those of
JPEG Pleno.

A video is a Y4M file of 4:4:4 samples by ITU-R BT.709, in limited range: R, G and B come back exactly
where it has two bits more than the views. --bits gives its bits (10 for views of 8, 12 up to 10, else
14). Grid, order and depth stand in its header; of videos by other programs --grid and --order tell.

Examples:
  hmlfc convert chess.hmlfc chess_qs3x3a1.33.png --row 4
  hmlfc convert chess.hmlfc lenslets.png --to lenslets
  hmlfc convert lenslets.png views --from lenslets --grid 9x9
  hmlfc convert views chess.y4m --order raster)");
  add_path(app, "INPUT", options.input, "Folder of views, .hmlfc file, picture or .y4m video");
  add_path(app, "OUTPUT", options.output, "Folder, .png, .ppm, .y4m or .hmlfc file to write");
  add_form(app, "--from", options.from, "Layout of a picture (with --grid) or folder that is read");
  add_form(app, "--to", options.to, "Layout of a picture or folder that is written");
  add_grid(app, options.grid);
  add_integer(app, "--row", options.row, 0, 4095, "Take this row of views alone");
  add_choice(app, "--order", options.order,
             {{"raster", io::FrameOrder::kRaster}, {"serpentine", io::FrameOrder::kSerpentine}},
             "Order of the views in a video; written: serpentine");
  add_choice(app, "--bits", options.bits, {{"8", 8}, {"10", 10}, {"12", 12}, {"14", 14}},
             "Bits of a sample in a video that is written");
  add_threads(app, options.threads);
}

}  // namespace hmlfc::cli
