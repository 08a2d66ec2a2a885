// hmlfc disparity: where a stream says that things are, as a picture or as numbers.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/disparity.hpp>

#include "cli/arguments.hpp"
#include "cli/view_source.hpp"
#include "io/disparity_files.hpp"
#include "io/disparity_range.hpp"
#include "io/image_files.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kDisparitySign = "hmlfc disparity";

struct DisparityOptions {
  std::filesystem::path file;
  std::filesystem::path output;
  bool force = false;
  std::optional<ViewPos> view;
  int sign = 1;  ///< of the numbers written, to those of the stream
};

enum class Format { kGrey, kGrey16, kPfm };

Format format_of(const std::filesystem::path& output) {
  const std::string extension = extension_of(output, ".pfm");
  if (extension == ".pfm") return Format::kPfm;
  if (extension != ".png") {
    throw Failure(ExitCode::kUsage,
                  output.string() + ": name it *.png, *.16.png or *.pfm; --help tells them apart");
  }
  return io::lower_case_extension(output.stem()) == ".16" ? Format::kGrey16 : Format::kGrey;
}

// A grey picture of `depth` bits: grey(block) for each pixel.
template <class Grey>
RgbImage picture_of(const DisparityMap& map, int depth, const Grey& grey) {
  RgbImage picture{map.width, map.height, depth, {}};
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      picture.samples.insert(picture.samples.end(), 3, static_cast<uint16_t>(grey(map.at(x, y))));
    }
  }
  return picture;
}

std::vector<float> pixels_a_column(const DisparityMap& map, int sign) {
  std::vector<float> pixels;
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      pixels.push_back(static_cast<float>(sign * map.at(x, y).disparity) / kDisparityUnits);
    }
  }
  return pixels;
}

io::IoResult<void> write_map(const std::filesystem::path& output, const DisparityMap& map,
                             const io::DisparityRange& range, int sign) {
  const Format format = format_of(output);
  if (format == Format::kPfm) {
    return io::write_pfm(output, map.width, map.height, pixels_a_column(map, sign));
  }
  if (format == Format::kGrey16) {
    const auto number = [&](const BlockDisparity& at) {
      return std::min(32768 + sign * at.disparity, 65535);
    };
    return io::write_png(output, picture_of(map, 16, number), kDisparitySign, true);
  }
  const int32_t steps = std::max(1, range.greatest - range.least);
  const auto nearness = [&](const BlockDisparity& at) {
    const int32_t nearer = range.greatest - at.disparity;
    return at.confidence == 0 ? 0 : (510 * nearer + steps) / (2 * steps);
  };
  return io::write_png(output, picture_of(map, 8, nearness), kDisparitySign, true);
}

ExitCode run_disparity(const DisparityOptions& options) {
  format_of(options.output);
  const OutputFile output(options.output, ".pfm", {kDisparitySign, options.force, {options.file}});
  const StreamFile file(options.file);
  const StreamHeader& header = file.header();
  const ViewPos view = options.view.value_or(ViewPos{(header.rows - 1) / 2, (header.cols - 1) / 2});
  file.check_view(view);
  const DisparityMap map = file.value(disparity_map(file.decoder(), view));
  io::DisparityRange range;
  range.add(map);
  value_or_throw(write_map(output.path(), map, range, options.sign), ExitCode::kOutput);
  output.finish();
  if (options.sign < 0) {
    range = {-range.greatest, -range.least, range.known, range.blocks};
  }
  print(fmt::format("{}: view {},{}, {}\n", options.output.string(), view.row, view.col,
                    describe(range)));
  return ExitCode::kDone;
}

}  // namespace

void add_disparity(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "disparity", "Write where a stream says that things are", run_disparity,
      R"(The disparity of a pixel is by how many pixels what it shows moves from a column of views to the
next: negative is nearer than what stands still, positive farther, as in render --focus. Streams of
profile extended hold it for blocks; it is 0 where a stream says nothing, as for key images of profile
main. The benchmark HCI 4D has the other sign: --positive near writes its numbers, and hmlfc compare
measures them.

The name of FILE chooses the format:
  *.pfm     32-bit floating point, pixels a column
  *.16.png  grey of 16 bits: 32768 + 256 times the disparity
  *.png     grey of 8 bits to look at: the nearest is white, the farthest and what is unknown black

Examples:
  hmlfc disparity chess.hmlfc --view 3,5 -o chess.pfm
  hmlfc disparity chess.hmlfc --positive near -o estimate.pfm)");
  add_stream(app, options.file);
  add_output(app, options.output, options.force, "FILE",
             "The file to write; - gives a PFM on standard output");
  add_view(app, options.view, "The view; counted from 0,0")->default_str("the middle one");
  add_choice(app, "--positive", options.sign, {{"far", 1}, {"near", -1}},
             "The sign of the numbers: which things have positive ones")
      ->default_str("far");
}

}  // namespace hmlfc::cli
