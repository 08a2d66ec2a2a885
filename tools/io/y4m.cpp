#include "io/y4m.hpp"

#include <algorithm>
#include <string_view>

#include "io/y4m_header.hpp"

namespace hmlfc::io {
namespace {

constexpr std::string_view kFrame = "FRAME";
constexpr size_t kLongestLine = 4096;  // bytes of a header of file or frame

// The line at `at`, without its end; nothing where it is longer than kLongestLine or cut off.
std::optional<std::string_view> line_at(std::span<const uint8_t> bytes, size_t at) {
  const auto rest = bytes.subspan(at, std::min(bytes.size() - at, kLongestLine));
  const auto end = std::ranges::find(rest, uint8_t{'\n'});
  if (end == rest.end()) return std::nullopt;
  return std::string_view(reinterpret_cast<const char*>(rest.data()),
                          static_cast<size_t>(end - rest.begin()));
}

size_t sample_bytes(const VideoLevels& levels) { return levels.bits > 8 ? 2 : 1; }

size_t frame_bytes(uint32_t width, uint32_t height, const VideoLevels& levels) {
  return size_t{3} * width * height * sample_bytes(levels);
}

// Where the samples of each frame begin, from the first frame at `at`.
tl::expected<std::vector<size_t>, std::string> find_frames(std::span<const uint8_t> bytes,
                                                           size_t at, size_t size) {
  std::vector<size_t> frames;
  while (at < bytes.size()) {
    const auto line = line_at(bytes, at);
    const std::string name = "frame " + std::to_string(frames.size());
    if (!line || !line->starts_with(kFrame)) {
      return tl::unexpected(name + " does not begin with FRAME, at byte " + std::to_string(at));
    }
    at += line->size() + 1;
    if (bytes.size() - at < size) return tl::unexpected(name + " is cut off");
    frames.push_back(at);
    at += size;
  }
  return frames;
}

int32_t sample_at(const uint8_t* plane, size_t index, const VideoLevels& levels) {
  if (levels.bits == 8) return plane[index];
  const int32_t stored = plane[2 * index] | plane[2 * index + 1] << 8;
  return stored & ((1 << levels.bits) - 1);
}

void store_sample(uint8_t* plane, size_t index, int32_t sample, const VideoLevels& levels) {
  if (levels.bits == 8) {
    plane[index] = static_cast<uint8_t>(sample);
  } else {
    plane[2 * index] = static_cast<uint8_t>(sample & 255);
    plane[2 * index + 1] = static_cast<uint8_t>(sample >> 8);
  }
}

}  // namespace

int exact_video_bits(int depth) { return depth <= 8 ? 10 : depth <= 10 ? 12 : 14; }

IoResult<Y4mReader> Y4mReader::open(const std::filesystem::path& file,
                                    std::optional<GridShape> grid,
                                    std::optional<FrameOrder> order) {
  auto mapped = map_file(file);
  if (!mapped) return tl::unexpected(mapped.error());
  Y4mReader video(std::move(*mapped));
  const auto bytes = video.file_.bytes();
  const auto line = line_at(bytes, 0);
  if (!line) return file_error(file, "not a Y4M video");
  const auto header = parse_y4m_header(*line);
  if (!header) return file_error(file, header.error());
  if (!grid && header->note) grid = header->note->grid;
  if (!grid) return file_error(file, "the video does not say rows and columns; give --grid");
  auto frames = find_frames(bytes, line->size() + 1,
                            frame_bytes(header->width, header->height, header->levels));
  if (!frames) return file_error(file, frames.error());
  if (frames->size() != size_t{grid->rows} * grid->cols) {
    return file_error(file, std::to_string(frames->size()) + " frames, not those of " +
                                std::to_string(grid->rows) + " x " + std::to_string(grid->cols) +
                                " views");
  }
  const int depth = header->note ? header->note->depth : std::min(header->levels.bits, 12);
  video.shape_ = {grid->rows, grid->cols, header->width, header->height, depth};
  video.order_ = order.value_or(header->note ? header->note->order : FrameOrder::kRaster);
  video.levels_ = header->levels;
  video.frames_ = std::move(*frames);
  return video;
}

RgbImage Y4mReader::view(uint32_t row, uint32_t col) const {
  const GridShape grid{shape_.rows, shape_.cols};
  const uint8_t* y = file_.bytes().data() + frames_[frame_of_view({row, col}, grid, order_)];
  RgbImage image{shape_.width, shape_.height, shape_.depth, {}};
  const size_t pixels = size_t{image.width} * image.height;
  const uint8_t* cb = y + pixels * sample_bytes(levels_);
  const uint8_t* cr = cb + pixels * sample_bytes(levels_);
  image.samples.reserve(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const YCbCr coded{sample_at(y, i, levels_), sample_at(cb, i, levels_),
                      sample_at(cr, i, levels_)};
    const Rgb pixel = rgb_of(coded, image.depth, levels_);
    for (const int32_t sample : {pixel.r, pixel.g, pixel.b}) {
      image.samples.push_back(static_cast<uint16_t>(sample));
    }
  }
  return image;
}

IoResult<Y4mWriter> Y4mWriter::create(const std::filesystem::path& file,
                                      const LightFieldShape& shape, FrameOrder order, int bits) {
  const VideoLevels levels{bits, false};
  const Y4mNote note{{shape.rows, shape.cols}, order, shape.depth};
  const std::string line = write_y4m_header({shape.width, shape.height, levels, note}) + "\n";
  return AtomicFile::create(file).and_then([&](AtomicFile created) -> IoResult<Y4mWriter> {
    const auto* const begin = reinterpret_cast<const uint8_t*>(line.data());
    if (auto ok = created.write({begin, line.size()}); !ok) return tl::unexpected(ok.error());
    return Y4mWriter(std::move(created), levels);
  });
}

IoResult<void> Y4mWriter::add(const RgbImage& view) {
  const size_t pixels = size_t{view.width} * view.height;
  const std::string line = std::string(kFrame) + "\n";
  std::vector<uint8_t> frame(line.begin(), line.end());
  frame.resize(line.size() + frame_bytes(view.width, view.height, levels_));
  uint8_t* y = frame.data() + line.size();
  uint8_t* cb = y + pixels * sample_bytes(levels_);
  uint8_t* cr = cb + pixels * sample_bytes(levels_);
  for (size_t i = 0; i < pixels; ++i) {
    const uint16_t* from = &view.samples[3 * i];
    const YCbCr pixel = ycbcr_of({from[0], from[1], from[2]}, view.depth, levels_);
    store_sample(y, i, pixel.y, levels_);
    store_sample(cb, i, pixel.cb, levels_);
    store_sample(cr, i, pixel.cr, levels_);
  }
  return file_.write(frame);
}

}  // namespace hmlfc::io
