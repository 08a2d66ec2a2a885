// The forms that hmlfc convert reads.
#include <string>
#include <utility>

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

// The views in a video.
class VideoSource final : public ViewSource {
 public:
  explicit VideoSource(io::Y4mReader video) : video_(std::move(video)) {}

  const LightFieldShape& shape() const override { return video_.shape(); }
  RgbImage view(ViewPos view) const override { return video_.view(view.row, view.col); }

 private:
  io::Y4mReader video_;
};

ConvertInput open_folder(const ConvertOptions& options) {
  const bool pleno = options.from == Form::kPleno;
  if (options.from && !pleno) {
    throw Failure(ExitCode::kUsage, "--from tiles and lenslets are for an input that is a picture");
  }
  io::ViewNaming naming = options.naming;
  if (pleno && naming.pattern.empty()) naming.pattern = "{col}_{row}";
  if (is_video(options.output)) naming.order.reset();
  const auto files = views_in(options.input, naming);
  ConvertInput input{ViewSource::of_files(options.input, files), std::nullopt};
  input.rig = rig_for(options.rig, Profile::kExtended, files, input.views->shape());
  return input;
}

ConvertInput open_stream(const ConvertOptions& options) {
  ConvertInput input{ViewSource::open(options.input), std::nullopt};
  if (!options.rig.none) input.rig = rig_in(StreamFile(options.input, {.check_sections = false}));
  return input;
}

std::unique_ptr<ViewSource> open_picture(const ConvertOptions& options) {
  const auto quilt = io::parse_quilt_name(options.input);
  if (quilt && !options.from) return std::make_unique<MosaicSource>(options.input, quilt->mosaic);
  if (!options.from || options.from == Form::kPleno || !options.naming.grid) {
    throw Failure(ExitCode::kUsage, options.input.string() +
                                        ": a picture needs --from tiles or lenslets and --grid, or "
                                        "the name of a quilt (_qsCxRaA)");
  }
  const auto layout = options.from == Form::kTiles ? MosaicLayout::kTiles : MosaicLayout::kLenslets;
  return std::make_unique<MosaicSource>(
      options.input, Mosaic{layout, options.naming.grid->rows, options.naming.grid->cols});
}

}  // namespace

bool is_picture(const std::filesystem::path& file) {
  const std::string extension = io::lower_case_extension(file);
  return extension == ".png" || extension == ".ppm" || extension == ".jpg" || extension == ".jpeg";
}

bool is_video(const std::filesystem::path& file) {
  return file == "-" || io::lower_case_extension(file) == ".y4m";
}

bool is_stream(const std::filesystem::path& file) {
  return io::lower_case_extension(file) == ".hmlfc";
}

ConvertInput open_input(const ConvertOptions& options) {
  if (std::filesystem::is_directory(options.input)) return open_folder(options);
  if (is_picture(options.input)) return {open_picture(options), std::nullopt};
  if (options.from) {
    throw Failure(ExitCode::kUsage, "--from is for an input that is a picture or a folder");
  }
  if (is_video(options.input)) {
    auto video = value_or_throw(
        io::Y4mReader::open(options.input, options.naming.grid, options.naming.order),
        ExitCode::kInput);
    return {std::make_unique<VideoSource>(std::move(video)), std::nullopt};
  }
  return open_stream(options);
}

}  // namespace hmlfc::cli
