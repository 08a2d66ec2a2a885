#include "cli/view_source.hpp"

#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "decoder/request_guard.hpp"
#include "io/image_files.hpp"

namespace hmlfc::cli {

namespace fs = std::filesystem;

namespace {

class FolderSource final : public ViewSource {
 public:
  explicit FolderSource(io::ViewList views) : views_(std::move(views)) {
    const RgbImage first = read(0);
    shape_ = {views_.rows, views_.cols, first.width, first.height, first.depth};
  }

  const LightFieldShape& shape() const override { return shape_; }

  RgbImage view(ViewPos view) const override {
    const size_t index = size_t{view.row} * views_.cols + view.col;
    RgbImage image = read(index);
    if (image.width == shape_.width && image.height == shape_.height &&
        image.depth == shape_.depth) {
      return image;
    }
    throw Failure(ExitCode::kInput,
                  fmt::format("{}: {} x {} pixels of {} bits, but the first view, {}, has {} x {} "
                              "of {}",
                              views_.files[index].string(), image.width, image.height, image.depth,
                              views_.files[0].string(), shape_.width, shape_.height, shape_.depth));
  }

 private:
  RgbImage read(size_t index) const {
    io::Notes notes;
    auto image = io::read_image(views_.files.at(index), {}, &notes);
    {
      const std::lock_guard lock(told_mutex_);
      tell(told_.add(notes));
    }
    return value_or_throw(std::move(image), ExitCode::kInput);
  }

  io::ViewList views_;
  mutable std::mutex told_mutex_;
  mutable io::Notes told_;
  LightFieldShape shape_;
};

class StreamSource final : public ViewSource {
 public:
  explicit StreamSource(const fs::path& file) : file_(file), shape_(shape_of(file_.header())) {}

  const LightFieldShape& shape() const override { return shape_; }

  RgbImage view(ViewPos view) const override {
    return file_.value(file_.decoder().decode_view(view));
  }

 private:
  StreamFile file_;
  LightFieldShape shape_;
};

void check_in_grid(ViewPos view, uint32_t rows, uint32_t cols) {
  if (view.row < rows && view.col < cols) return;
  throw Failure(ExitCode::kUsage,
                fmt::format("--view {},{} does not exist: rows 0 to {}, columns 0 to {}", view.row,
                            view.col, rows - 1, cols - 1));
}

}  // namespace

std::shared_ptr<const remote::OpenSource> open_source(const std::filesystem::path& path) {
  if (path == "-") {
    throw Failure(ExitCode::kUsage,
                  "-: parts of a stream are read in any order, standard input in one; name a file");
  }
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw Failure(
        ExitCode::kInput,
        path.string() + ": not a stream, but a folder; hmlfc encode makes one of its views");
  }
  return std::make_shared<const remote::OpenSource>(
      value_or_throw(remote::open_source(path), ExitCode::kInput));
}

StreamFile::StreamFile(std::filesystem::path path, const OpenOptions& options)
    : StreamFile(path, open_source(path), options) {}

StreamFile::StreamFile(std::filesystem::path path, std::shared_ptr<const remote::OpenSource> source,
                       const OpenOptions& options)
    : path_(std::move(path)), source_(std::move(source)), decoder_(value(open(options))) {}

Result<Decoder> StreamFile::open(OpenOptions options) const {
  options.check_sections = options.check_sections && !is_remote();
  return Decoder::open(*source_->bytes, options);
}

Failure StreamFile::failure(const Error& error) const {
  const std::string reason = source_->bytes->failure();
  if (reason.empty()) return stream_failure(path_, error);
  return Failure(ExitCode::kInput, reason);
}

std::optional<remote::FetchCounts> StreamFile::fetched() const {
  if (!is_remote()) return std::nullopt;
  return source_->http->counts();
}

void StreamFile::check_readable() const {
  const std::string reason = source_->bytes->failure();
  if (!reason.empty()) throw Failure(ExitCode::kInput, reason);
}

void StreamFile::with_bytes(ByteRange range,
                            const std::function<void(std::span<const uint8_t>)>& use) const {
  ByteSource& source = *source_->bytes;
  const HeldBytes held(source.is_partial() ? &source : nullptr);
  if (source.is_partial() && !source.load({&range, 1})) check_readable();
  use(source.bytes().subspan(static_cast<size_t>(range.offset), static_cast<size_t>(range.bytes)));
}

Result<void> StreamFile::check_sections() const {
  const auto checked = open({});
  if (!checked) return tl::unexpected(checked.error());
  return {};
}

void StreamFile::check_view(ViewPos view) const {
  check_in_grid(view, header().rows, header().cols);
}

int StreamFile::stop_level(int levels) const {
  const int all = header().tree_height + 1;
  if (levels >= 1 && levels <= all) return all - levels;
  throw Failure(ExitCode::kUsage,
                fmt::format("--levels {} is outside [1, {}]: {} has {} level{}; a larger "
                            "--height of encode makes more, as far as the grid has images",
                            levels, all, path_.string(), all, all == 1 ? "" : "s"));
}

io::ViewList views_in(const fs::path& folder, const io::ViewNaming& naming) {
  auto views = value_or_throw(io::list_views(folder, naming), ExitCode::kInput);
  for (const std::string& text : views.notes) note(text);
  return views;
}

std::unique_ptr<ViewSource> ViewSource::open(const fs::path& path, const io::ViewNaming& naming,
                                             const fs::path& other) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) return of_files(views_in(path, naming));
  auto stream = std::make_unique<StreamSource>(path);
  if (!fs::is_directory(other, failure)) {
    refuse_naming(naming, path.string() + " is a stream, which has its grid; leave it out");
  }
  return stream;
}

std::unique_ptr<ViewSource> ViewSource::of_files(io::ViewList files) {
  return std::make_unique<FolderSource>(std::move(files));
}

void ViewSource::check_view(ViewPos view) const { check_in_grid(view, shape().rows, shape().cols); }

void check_rect(const Rect& rect, const LightFieldShape& shape) {
  if (rect.width > 0 && rect.height > 0 && rect.x < shape.width && rect.y < shape.height &&
      rect.width <= shape.width - rect.x && rect.height <= shape.height - rect.y) {
    return;
  }
  throw Failure(ExitCode::kUsage,
                fmt::format("--rect {},{},{},{} does not lie in the {} x {} pixels of a view",
                            rect.x, rect.y, rect.width, rect.height, shape.width, shape.height));
}

LightFieldShape shape_of(const StreamHeader& header) {
  return {header.rows, header.cols, header.width, header.height, header.depth};
}

std::string describe(const LightFieldShape& shape) {
  return fmt::format("{} x {} views of {} x {} pixels, {} bits", shape.rows, shape.cols,
                     shape.width, shape.height, shape.depth);
}

}  // namespace hmlfc::cli
