// hmlfc decode: views of a stream, or parts of them, as PNG files.
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/for_each_view.hpp"
#include "cli/view_source.hpp"
#include "io/image_files.hpp"
#include "io/light_field_files.hpp"
#include "io/view_name.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kDecodeSign = "hmlfc decode";

struct DecodeOptions {
  std::filesystem::path file;
  std::filesystem::path output;
  bool force = false;
  std::optional<ViewPos> view;
  std::optional<Rect> rect;
  std::optional<int> levels;
  int threads = 0;
};

// Writes views of one stream into one folder, or one view into a file.
class ViewWriter {
 public:
  ViewWriter(const DecodeOptions& options, const StreamHeader& header)
      : folder_(options.output), header_(header) {
    const Replacing replacing{kDecodeSign, options.force, {options.file}};
    if (options.view && extension_of(options.output, ".png") == ".png") {
      file_.emplace(options.output, ".png", replacing);
      return;
    }
    check_extension(options.output, "a folder of views", {});
    const io::GridShape grid{header.rows, header.cols};
    auto names = options.view ? std::vector{name_of(*options.view)}
                              : io::view_file_names(grid, io::FileNames::kRowCol);
    make_output_folder(options.output, names, replacing);
  }

  void write(ViewPos view, const RgbImage& image) const {
    const auto file = file_ ? file_->path() : folder_ / name_of(view);
    value_or_throw(io::write_png(file, image, kDecodeSign), ExitCode::kOutput);
    if (file_) file_->finish();
  }

 private:
  std::string name_of(ViewPos view) const {
    return io::view_file_name(view.row, view.col, header_.rows, header_.cols);
  }

  const std::filesystem::path& folder_;
  const StreamHeader& header_;
  std::optional<OutputFile> file_;
};

// All views in full: shared ancestors are decoded once.
void decode_everything(const StreamFile& file, const ViewWriter& writer, int stop_level,
                       int threads, const io::Progress& progress) {
  const StreamHeader& header = file.header();
  const size_t count = size_t{header.rows} * header.cols;
  FirstFailure first;
  std::mutex mutex;
  size_t done = 0;
  const auto write_view = [&](ViewPos view, RgbImage&& image) {
    guard(first, size_t{view.row} * header.cols + view.col, [&] { writer.write(view, image); });
    const std::scoped_lock lock(mutex);
    progress(++done, count);
  };
  file.value(file.decoder().decode_all(write_view, {stop_level, threads}));
  rethrow(first);
}

// Parts of views, or a single view.
void decode_parts(const StreamFile& file, const ViewWriter& writer, int stop_level,
                  const DecodeOptions& options, const io::Progress& progress) {
  const StreamHeader& header = file.header();
  const Rect rect = options.rect.value_or(Rect{0, 0, header.width, header.height});
  const auto decode_view = [&](ViewPos view) {
    const auto image = file.decoder().decode_rgb(view, rect, stop_level);
    writer.write(view, file.value(image));
  };
  if (options.view) return decode_view(*options.view);
  for_each_view({header.rows, header.cols}, options.threads, progress, decode_view);
}

ExitCode run_decode(const DecodeOptions& options) {
  const ThreadLimit limit(options.threads);
  const StreamFile file(options.file);
  if (options.view) file.check_view(*options.view);
  if (options.rect) check_rect(*options.rect, shape_of(file.header()));
  const int stop_level = options.levels ? file.stop_level(*options.levels) : 0;
  const ViewWriter writer(options, file.header());
  terminal::ProgressBar progress("Decoding", "views");
  if (options.view || options.rect) {
    decode_parts(file, writer, stop_level, options, progress.callback());
  } else {
    decode_everything(file, writer, stop_level, options.threads, progress.callback());
  }
  progress.clear();
  const StreamHeader& header = file.header();
  const uint64_t count = options.view ? 1 : uint64_t{header.rows} * header.cols;
  print(fmt::format("{}: {} view{} of {} x {} pixels\n", options.output.string(), count,
                    count == 1 ? "" : "s", options.rect ? options.rect->width : header.width,
                    options.rect ? options.rect->height : header.height));
  return ExitCode::kDone;
}

}  // namespace

void add_decode(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "decode", "Decode views of a stream to PNG files", run_decode,
      R"(With --levels 1 each view shows its ancestor at the top of the tree, with 2 its ancestor one level
below, and so on. A stream has one level more than the --height it was encoded with. Files are named
by row and column: 00_00.png, 00_01.png ... Their samples have 16 bits if the stream has more than 8.

Example:
  hmlfc decode chess.hmlfc -o decoded --view 3,5 --rect 0,0,128,64)");
  add_stream(app, options.file);
  add_output(app, options.output, options.force, "DIR|FILE.png",
             "Folder for the views, or the file of one");
  add_view(app, options.view, "Only this view; counted from 0,0");
  add_rect(app, options.rect);
  add_levels(app, options.levels);
  add_threads(app, options.threads);
}

}  // namespace hmlfc::cli
