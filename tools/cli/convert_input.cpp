// The forms that hmlfc convert reads.
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/convert_forms.hpp"
#include "io/files.hpp"
#include "io/image_files.hpp"
#include "io/view_mosaic.hpp"

namespace hmlfc::cli {
namespace {

using io::Mosaic;
using io::MosaicLayout;

// The views in one picture.
class MosaicSource final : public ViewSource {
 public:
  MosaicSource(const std::filesystem::path& file, const Mosaic& mosaic) : mosaic_(mosaic) {
    io::Notes notes;
    picture_ = value_or_throw(io::read_image(file, {}, &notes), ExitCode::kInput);
    tell(notes);
    shape_ = value_or_throw(io::mosaic_shape(file, picture_, mosaic), ExitCode::kInput);
  }

  const LightFieldShape& shape() const override { return shape_; }

  // Columns and rows of pixels of no view.
  std::array<uint32_t, 2> rest() const {
    return {picture_.width % mosaic_.cols, picture_.height % mosaic_.rows};
  }

  RgbImage view(ViewPos view) const override {
    return io::view_of_mosaic(picture_, mosaic_, view.row, view.col);
  }

 private:
  Mosaic mosaic_;
  RgbImage picture_;
  LightFieldShape shape_;
};

// Tells what of a quilt is left out, and where its name says something else.
void note_quilt(const std::filesystem::path& file, const io::QuiltName& quilt,
                const MosaicSource& source) {
  const LightFieldShape& view = source.shape();
  const auto [width, height] = source.rest();
  if (width + height > 0) {
    std::string cut;
    const auto add = [&cut](uint32_t count, const char* what, const char* where) {
      if (count == 0) return;
      cut += fmt::format("{}{} {}{} of pixels {}", cut.empty() ? "" : " and ", count, what,
                         count == 1 ? "" : "s", where);
    };
    add(width, "column", "on the right");
    add(height, "row", "on top");
    note(fmt::format("{}: {} x {} tiles of {} x {} pixels; {} {} cut off", file.string(),
                     quilt.mosaic.cols, quilt.mosaic.rows, view.width, view.height, cut,
                     width + height == 1 ? "is" : "are"));
  }
  const double aspect = static_cast<double>(view.width) / view.height;
  if (std::abs(quilt.aspect.value_or(aspect) / aspect - 1) > 0.01) {
    note(
        fmt::format("{}: the aspect of a tile is {:.4g}, the name says {:.4g}; pixels are kept as "
                    "they are",
                    file.string(), aspect, *quilt.aspect));
  }
}

// The views in a video.
class VideoSource final : public ViewSource {
 public:
  explicit VideoSource(io::Y4mReader video) : video_(std::move(video)) {}

  const LightFieldShape& shape() const override { return video_.shape(); }
  RgbImage view(ViewPos view) const override { return video_.view(view.row, view.col); }

 private:
  io::Y4mReader video_;
};

ConvertInput open_folder(const ConvertOptions& options, io::ViewNaming naming) {
  const bool pleno = options.from == Form::kPleno;
  if (options.from && !pleno) {
    throw Failure(ExitCode::kUsage, "--from tiles and lenslets are for an input that is a picture");
  }
  if (pleno) {
    refuse_naming({.pattern = naming.pattern, .order = naming.order},
                  "--from pleno says how files are named; leave it out");
    naming.pattern = "{col}_{row}";
  }
  const auto files = views_in(options.input, naming);
  ConvertInput input{ViewSource::of_files(files), std::nullopt};
  input.rig = rig_for(options.rig, Profile::kExtended, files, input.views->shape());
  return input;
}

ConvertInput open_stream(const ConvertOptions& options, const io::ViewNaming& naming) {
  ConvertInput input{ViewSource::open(options.input, naming), std::nullopt};
  if (!options.rig.none) input.rig = rig_in(StreamFile(options.input, {.check_sections = false}));
  return input;
}

std::unique_ptr<ViewSource> open_picture(const ConvertOptions& options,
                                         const io::ViewNaming& naming) {
  refuse_naming({.pattern = naming.pattern, .order = naming.order},
                "views in one picture have neither names nor an order; leave it out");
  const auto quilt = io::parse_quilt_name(options.input);
  if (quilt && !options.from) {
    const auto& grid = naming.grid;
    const io::GridShape views = quilt->mosaic.grid();
    if (grid && (grid->rows != views.rows || grid->cols != views.cols)) {
      throw Failure(
          ExitCode::kUsage,
          fmt::format("{}: the quilt's name says {}x{} views, --grid {}x{}", options.input.string(),
                      views.rows, views.cols, grid->rows, grid->cols));
    }
    auto source = std::make_unique<MosaicSource>(options.input, quilt->mosaic);
    note_quilt(options.input, *quilt, *source);
    return source;
  }
  if (!options.from || options.from == Form::kPleno || !naming.grid) {
    throw Failure(
        ExitCode::kUsage,
        fmt::format(
            "{0}: one picture, whose layout is not known; name its folder if it is one view, "
            "else hmlfc convert {0} FOLDER "
            "--from tiles (or lenslets) --grid ROWSxCOLS tells it, or the name of a "
            "quilt, NAME_qsCxR.png",
            options.input.string()));
  }
  const auto layout = options.from == Form::kTiles ? MosaicLayout::kTiles : MosaicLayout::kLenslets;
  return std::make_unique<MosaicSource>(options.input,
                                        Mosaic{layout, naming.grid->rows, naming.grid->cols});
}

}  // namespace

bool is_picture(const std::filesystem::path& file) {
  return io::is_picture_name("a" + file.extension().string());
}

bool is_video(const std::filesystem::path& file) {
  return file == "-" || io::lower_case_extension(file) == ".y4m";
}

bool is_stream(const std::filesystem::path& file) {
  return io::lower_case_extension(file) == ".hmlfc";
}

ConvertInput open_input(const ConvertOptions& options) {
  io::ViewNaming naming = options.naming;
  if (is_video(options.output)) naming.order.reset();  // it is that of the output
  if (std::filesystem::is_directory(options.input)) return open_folder(options, naming);
  if (is_picture(options.input)) return {open_picture(options, naming), std::nullopt};
  if (options.from) {
    throw Failure(ExitCode::kUsage, "--from is for an input that is a picture or a folder");
  }
  if (is_video(options.input)) {
    auto video = value_or_throw(io::Y4mReader::open(options.input, naming.grid, naming.order),
                                ExitCode::kInput);
    refuse_naming({.pattern = naming.pattern}, "frames of a video have no names; leave it out");
    if (!video.note().empty()) note(options.input.string() + ": " + video.note());
    return {std::make_unique<VideoSource>(std::move(video)), std::nullopt};
  }
  return open_stream(options, naming);
}

}  // namespace hmlfc::cli
