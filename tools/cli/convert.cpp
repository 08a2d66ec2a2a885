// hmlfc convert: a light field from one form into another, sample for sample.
#include <memory>
#include <optional>
#include <utility>
#include <vector>

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

// Keeps the entries of grid row `row`; a single shared entry is kept as it is.
template <class Entry>
void keep_row(std::vector<Entry>& entries, const LightFieldShape& shape, uint32_t row) {
  if (entries.size() != size_t{shape.rows} * shape.cols) return;
  const auto first = entries.begin() + static_cast<ptrdiff_t>(size_t{row} * shape.cols);
  entries = std::vector<Entry>(first, first + static_cast<ptrdiff_t>(shape.cols));
}

// Row `row` of `input` alone.
ConvertInput row_of(ConvertInput input, uint32_t row) {
  input.views->check_view({row, 0});
  if (input.rig) {
    keep_row(input.rig->rig.positions, input.views->shape(), row);
    keep_row(input.rig->rig.rotations, input.views->shape(), row);
    keep_row(input.rig->rig.intrinsics, input.views->shape(), row);
  }
  input.views = std::make_unique<RowSource>(std::move(input.views), row);
  return input;
}

ExitCode run_convert(const ConvertOptions& given) {
  ConvertOptions options = given;
  check_output(options);
  std::optional<OutputFile> file;
  const bool is_picture_form = is_picture(options.output);
  if (is_picture_form || is_video(options.output) || is_stream(options.output)) {
    const std::string_view sign = is_picture_form             ? kConvertSign
                                  : is_stream(options.output) ? kStreamSign
                                                              : kVideoSign;
    file.emplace(options.output, ".y4m", Replacing{sign, options.force, {options.input}});
    options.output = file->path();
  }
  const ThreadLimit limit(options.threads);
  ConvertInput input = open_input(options);
  if (options.row) input = row_of(std::move(input), *options.row);
  terminal::ProgressBar progress("Converting", "views");
  write_output(options, input, progress.callback());
  progress.clear();
  if (file) file->finish();
  print(fmt::format("{}: {}\n", given.output.string(), describe(input.views->shape())));
  return ExitCode::kDone;
}

}  // namespace

void add_convert(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "convert", "Turn a light field into another form, sample for sample",
      run_convert,
      R"(A form is a folder of views, an .hmlfc file (written without loss), a video, or a picture of
all views, PNG or PPM:
  quilt     by its name, NAME_qsCxRaA.png: C columns and R rows of tiles, from the bottom left, with
            the views of one row of cameras; A, which may be missing, is the aspect of a view
  tiles     view R,C is the tile in row R and column C
  lenslets  pixel X,Y of view R,C is pixel X * COLS + C, Y * ROWS + R

--from pleno and --to pleno are for folders whose files say the column first, CCC_RRR.ppm, as those of
JPEG Pleno. --to hci writes a folder as the HCI 4D Light Field Benchmark's: input_CamNNN.png and, where
the cameras stand on a square grid, parameters.cfg; what no rig tells is nan there.

Where the cameras stand, the rig, goes from .hmlfc files and folders to such: a folder holds it as
rig.json, as parameters.cfg or in names (hmlfc encode --help).

A video is a Y4M file of 4:4:4 samples by ITU-R BT.709, in limited range: R, G and B come back exactly
where it has two bits more than the views. --bits gives its bits (10 for views of 8, 12 up to 10, else
14). Grid, order and depth stand in its header; of videos by other programs --grid and --order tell.
A video that is written has --order, serpentine by default; what is read for it has an order of its own.
Videos of 4:2:2, 4:2:0 and grey, of 8 to 16 bits, are read too.

Examples:
  hmlfc convert chess.hmlfc chess_qs3x3a1.33.png --row 4
  hmlfc convert chess.hmlfc lenslets.png --to lenslets
  hmlfc convert lenslets.png views --from lenslets --grid 9x9
  hmlfc convert views chess.y4m --order raster
  hmlfc convert chess.hmlfc benchmark --to hci)");
  add_path(app, "INPUT", options.input, "Folder of views, .hmlfc file, picture or .y4m video");
  add_path(app, "OUTPUT", options.output,
           "Folder, .png, .ppm, .y4m or .hmlfc file to write, - for Y4M");
  add_force(app, options.force);
  add_choice(app, "--from", options.from,
             {{"tiles", Form::kTiles}, {"lenslets", Form::kLenslets}, {"pleno", Form::kPleno}},
             "Layout of a picture (with --grid) or folder that is read");
  add_choice(app, "--to", options.to,
             {{"tiles", Form::kTiles},
              {"lenslets", Form::kLenslets},
              {"pleno", Form::kPleno},
              {"hci", Form::kHci}},
             "Layout of a picture or folder that is written");
  add_naming(app, options.naming);
  add_integer(app, "--row", options.row, 0, 4095, "Take this row of views alone");
  add_choice(app, "--bits", options.bits, {{"8", 8}, {"10", 10}, {"12", 12}, {"14", 14}},
             "Bits of a sample in a video that is written");
  app.add_flag("--no-rig", options.rig.none, "Leave out where the cameras stand");
  add_threads(app, options.threads);
}

}  // namespace hmlfc::cli
