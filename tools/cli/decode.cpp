// hmlfc decode: views of a stream, or parts of them, as PNG files.
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/for_each_view.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/stream_file.hpp"
#include "io/view_name.hpp"
#include "io/write_image.hpp"

namespace hmlfc::cli {
namespace {

struct DecodeOptions {
  std::filesystem::path file;
  std::filesystem::path folder;
  std::optional<ViewPos> view;
  std::optional<Rect> rect;
  std::optional<int> levels;
  int threads = 0;
};

// Writes views of one stream into one folder.
class ViewWriter {
 public:
  ViewWriter(const std::filesystem::path& folder, const StreamHeader& header)
      : folder_(folder), header_(header) {}

  void write(ViewPos view, const RgbImage& image) const {
    const auto file = folder_ / io::view_file_name(view.row, view.col, header_.rows, header_.cols);
    value_or_throw(io::write_png(file, image), ExitCode::kOutput);
  }

 private:
  const std::filesystem::path& folder_;
  const StreamHeader& header_;
};

void check_rect(const Rect& rect, const StreamFile& file) {
  const StreamHeader& header = file.header();
  if (rect.width > 0 && rect.height > 0 && rect.x < header.width && rect.y < header.height &&
      rect.width <= header.width - rect.x && rect.height <= header.height - rect.y) {
    return;
  }
  throw Failure(ExitCode::kUsage,
                fmt::format("--rect {},{},{},{} does not lie in the {} x {} pixels of a view",
                            rect.x, rect.y, rect.width, rect.height, header.width, header.height));
}

// All views in full: shared ancestors are decoded once.
void decode_everything(const StreamFile& file, const ViewWriter& writer, int stop_level,
                       int threads, const io::Progress& progress) {
  const StreamHeader& header = file.header();
  const size_t count = size_t{header.rows} * header.cols;
  FirstFailure first;
  std::mutex mutex;
  size_t done = 0;
  const auto write_view = [&](ViewPos view, RgbImage&& image) {
    first.guard(size_t{view.row} * header.cols + view.col, [&] { writer.write(view, image); });
    const std::scoped_lock lock(mutex);
    progress(++done, count);
  };
  value_or_throw(file.decoder().decode_all(write_view, {stop_level, threads}), file.path());
  first.rethrow();
}

// Parts of views, or a single view.
void decode_parts(const StreamFile& file, const ViewWriter& writer, int stop_level,
                  const DecodeOptions& options, const io::Progress& progress) {
  const StreamHeader& header = file.header();
  const Rect rect = options.rect.value_or(Rect{0, 0, header.width, header.height});
  const auto decode_view = [&](ViewPos view) {
    const auto image = file.decoder().decode_rgb(view, rect, stop_level);
    writer.write(view, value_or_throw(image, file.path()));
  };
  if (options.view) return decode_view(*options.view);
  for_each_view({header.rows, header.cols}, options.threads, progress, decode_view);
}

ExitCode run_decode(const DecodeOptions& options) {
  const ThreadLimit limit(options.threads);
  const StreamFile file(options.file);
  if (options.view) file.check_view(*options.view);
  if (options.rect) check_rect(*options.rect, file);
  const int stop_level = options.levels ? file.stop_level(*options.levels) : 0;
  make_output_folder(options.folder);
  const ViewWriter writer(options.folder, file.header());
  ProgressBar progress("Decoding", "views");
  if (options.view || options.rect) {
    decode_parts(file, writer, stop_level, options, progress.callback());
  } else {
    decode_everything(file, writer, stop_level, options.threads, progress.callback());
  }
  progress.clear();
  const StreamHeader& header = file.header();
  const uint64_t count = options.view ? 1 : uint64_t{header.rows} * header.cols;
  print(fmt::format("{}: {} view{} of {} x {} pixels\n", options.folder.string(), count,
                    count == 1 ? "" : "s", options.rect ? options.rect->width : header.width,
                    options.rect ? options.rect->height : header.height));
  return ExitCode::kDone;
}

CLI::Option* add_rect(CLI::App& app, std::optional<Rect>& target) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_numbers<4>(text, ',');
    if (!numbers) return "x,y,width,height, as 16,8,64,32";
    target = Rect{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
    return std::nullopt;
  };
  return add_value(app, "--rect", "X,Y,W,H", "Only these pixels of each view", reader);
}

}  // namespace

void add_decode(CLI::App& program, Task& task) {
  const auto options = std::make_shared<DecodeOptions>();
  CLI::App* app = program.add_subcommand("decode", "Decode views of a stream to PNG files");
  add_path(*app, "FILE", options->file, "An .hmlfc file");
  add_output(*app, options->folder, "DIR", "Folder for the views, made if it is missing");
  add_view(*app, options->view, "Only this view; counted from 0,0");
  add_rect(*app, options->rect);
  add_levels(*app, options->levels);
  add_threads(*app, options->threads);
  app->footer(
      R"(With --levels 1 each view shows its ancestor at the top of the tree, with one level more the next.
The files are named by row and column: 00_00.png, 00_01.png ... Samples of more than 8 bits make PNG
files of 16 bits.

Example:
  hmlfc decode chess.hmlfc -o decoded --view 3,5 --rect 0,0,128,64)");
  app->callback([&task, options] { task = [options] { return run_decode(*options); }; });
}

}  // namespace hmlfc::cli
