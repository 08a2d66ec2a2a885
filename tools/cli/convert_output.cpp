// The forms that hmlfc convert writes.
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <hmlfc/encoder.hpp>

#include "cli/arguments.hpp"
#include "cli/convert_forms.hpp"
#include "cli/encode_outcome.hpp"
#include "cli/for_each_view.hpp"
#include "io/files.hpp"
#include "io/hci_parameters.hpp"
#include "io/image_files.hpp"
#include "io/light_field_files.hpp"
#include "io/rig_files.hpp"
#include "io/rig_text.hpp"
#include "io/view_mosaic.hpp"

namespace hmlfc::cli {
namespace {

using io::Mosaic;
using io::MosaicLayout;

// The quilt that the output's name states, which must be that of the views.
Mosaic quilt_of(const std::filesystem::path& file, const LightFieldShape& shape) {
  if (shape.rows != 1) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: a quilt has one row of views, not {}; choose one by --row",
                              file.string(), shape.rows));
  }
  const auto quilt = *io::parse_quilt_name(file);
  const double aspect = static_cast<double>(shape.width) / shape.height;
  if (quilt.mosaic.grid().cols != shape.cols ||
      std::abs(quilt.aspect.value_or(aspect) - aspect) > 0.01) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: the views are {} of aspect {:.4g}; the name says {} x {} of "
                              "aspect {:.4g}",
                              file.string(), shape.cols, aspect, quilt.mosaic.cols,
                              quilt.mosaic.rows, quilt.aspect.value_or(aspect)));
  }
  return quilt.mosaic;
}

Mosaic output_mosaic(const ConvertOptions& options, const LightFieldShape& shape) {
  if (options.to) {
    const auto layout = options.to == Form::kTiles ? MosaicLayout::kTiles : MosaicLayout::kLenslets;
    return {layout, shape.rows, shape.cols};
  }
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
  value_or_throw(ppm ? io::write_ppm(options.output, picture)
                     : io::write_png(options.output, picture, kConvertSign),
                 ExitCode::kOutput);
}

io::FileNames names_of(const std::optional<Form>& form) {
  if (!form) return io::FileNames::kRowCol;
  return form == Form::kPleno ? io::FileNames::kPleno : io::FileNames::kHci;
}

// The file that says where the cameras of `shape` stand, and its text.
std::pair<std::string_view, std::string> rig_file(const ConvertOptions& options, const Rig& rig,
                                                  const LightFieldShape& shape) {
  if (options.to != Form::kHci) return {io::kRigName, io::rig_text(rig) + "\n"};
  const auto parameters = io::hci_parameters_of(rig, shape);
  if (!parameters) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: {} cannot hold the rig: {}; --no-rig leaves it out",
                              options.output.string(), io::kHciParametersName, parameters.error()));
  }
  return {io::kHciParametersName, io::hci_parameters_text(*parameters)};
}

void write_folder(const ConvertOptions& options, const ConvertInput& input,
                  const io::Progress& progress) {
  const LightFieldShape& shape = input.views->shape();
  std::pair<std::string_view, std::string> beside;
  if (input.rig) beside = rig_file(options, input.rig->rig, shape);
  const auto produce = [&input](uint32_t row, uint32_t col) -> io::IoResult<RgbImage> {
    return input.views->view({row, col});
  };
  auto files = io::view_file_names({shape.rows, shape.cols}, names_of(options.to));
  // Where views of an earlier output may be replaced, the file beside them may be, too.
  if (input.rig && !std::filesystem::exists(options.output / files.front())) {
    files.emplace_back(beside.first);
  }
  make_output_folder(options.output, files, {kConvertSign, options.force, {options.input}});
  value_or_throw(io::save_views(options.output, {shape.rows, shape.cols}, produce,
                                static_cast<unsigned>(options.threads), progress,
                                {names_of(options.to), kConvertSign}),
                 ExitCode::kOutput);
  const auto& [name, text] = beside;
  if (!input.rig) return;
  value_or_throw(io::write_file(options.output / name,
                                {reinterpret_cast<const uint8_t*>(text.data()), text.size()}),
                 ExitCode::kOutput);
}

void write_video(const ConvertOptions& options, const ViewSource& source,
                 const io::Progress& progress) {
  const LightFieldShape& shape = source.shape();
  const int bits = options.bits.value_or(io::exact_video_bits(shape.depth));
  if (bits < shape.depth) {
    throw Failure(ExitCode::kUsage, fmt::format("--bits {} is less than the {} bits of the views",
                                                bits, shape.depth));
  }
  const io::FrameOrder order = options.naming.order.value_or(io::FrameOrder::kSerpentine);
  auto video =
      value_or_throw(io::Y4mWriter::create(options.output, shape, order, bits), ExitCode::kOutput);
  const size_t count = size_t{shape.rows} * shape.cols;
  for (size_t i = 0; i < count; ++i) {
    const auto [row, col] = io::view_of_frame(i, {shape.rows, shape.cols}, order);
    value_or_throw(video.add(source.view({row, col})), ExitCode::kOutput);
    if (progress) progress(i + 1, count);
  }
  value_or_throw(video.commit(), ExitCode::kOutput);
}

// Every sample is kept.
void write_stream(const ConvertOptions& options, const ConvertInput& input,
                  const io::Progress& progress) {
  const LightField field = all_views(*input.views, options.threads, {});
  EncodeParams params;
  params.profile = Profile::kExtended;
  params.lossless = true;
  params.threads = options.threads;
  auto stream = encode(field, params, progress);
  if (!stream) throw encode_failure(options.input, stream.error());
  if (input.rig) stream->bytes = stream_with_rig(stream->bytes, *input.rig);
  value_or_throw(io::write_file(options.output, stream->bytes), ExitCode::kOutput);
}

}  // namespace

void check_output(const ConvertOptions& options) {
  const std::filesystem::path& file = options.output;
  const auto usage = [](const std::string& what) { throw Failure(ExitCode::kUsage, what); };
  const std::string extension = io::lower_case_extension(file);
  if (is_picture(file) && extension != ".png" && extension != ".ppm") {
    usage(file.string() +
          ": pictures are written as .png or .ppm; or write a folder, .y4m or .hmlfc");
  }
  const bool is_folder = !is_picture(file) && !is_video(file) && !is_stream(file);
  const bool for_folder = options.to == Form::kPleno || options.to == Form::kHci;
  if (options.to && is_picture(file) == for_folder) {
    usage(
        "--to pleno and hci are for an output that is a folder, tiles and lenslets for a picture");
  }
  if (options.to && !is_picture(file) && !is_folder) {
    usage("--to is for an output that is a picture or a folder");
  }
  if (options.bits && !is_video(file)) usage("--bits is for an output that is a video");
  if (is_folder) check_extension(file, "a folder, .png, .ppm, .y4m or .hmlfc", {});
}

LightField all_views(const ViewSource& source, int threads, const io::Progress& progress) {
  LightField field(source.shape());
  for_each_view({field.shape().rows, field.shape().cols}, threads, progress,
                [&](ViewPos view) { field.set_view(view.row, view.col, source.view(view)); });
  return field;
}

void write_output(const ConvertOptions& options, const ConvertInput& input,
                  const io::Progress& progress) {
  if (is_stream(options.output)) return write_stream(options, input, progress);
  const bool picture = is_picture(options.output);
  if (!picture && !is_video(options.output)) return write_folder(options, input, progress);
  if (input.rig) note(options.output.string() + ": holds no rig; that of the input is left out");
  (picture ? write_picture : write_video)(options, *input.views, progress);
}

}  // namespace hmlfc::cli
