#include "io/y4m.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

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

// How many samples of Cb or Cr lie along `side` pixels.
size_t chroma_length(uint32_t side, ChromaSide kind) {
  return kind == ChromaSide::kEach ? side : (size_t{side} + 1) / 2;
}

size_t chroma_samples(const LightFieldShape& shape, const ChromaPlanes& chroma) {
  if (!chroma.there) return 0;
  return chroma_length(shape.width, chroma.x) * chroma_length(shape.height, chroma.y);
}

size_t frame_samples(const LightFieldShape& shape, const ChromaPlanes& chroma) {
  return size_t{shape.width} * shape.height + 2 * chroma_samples(shape, chroma);
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
  return plane[2 * index] | plane[2 * index + 1] << 8;
}

// Whether each of `samples` has the bits that `levels` say.
bool is_in_range(const uint8_t* plane, size_t samples, const VideoLevels& levels) {
  int32_t all = 0;
  if (levels.bits == 8) return true;
  for (size_t i = 0; i < samples; ++i) all |= sample_at(plane, i, levels);
  return all >> levels.bits == 0;
}

// Between which samples of Cb and Cr along one side pixel `at` lies: `far` counts in quarters.
struct Between {
  size_t near_at;
  size_t far_at;
  int32_t far;
};

Between between(size_t at, size_t length, ChromaSide kind) {
  if (kind == ChromaSide::kEach) return {at, at, 0};
  const size_t half = at / 2;
  const bool first = at % 2 == 0;
  const size_t next = std::min(half + 1, length - 1);
  if (kind == ChromaSide::kCosited) return {half, next, first ? 0 : 2};
  return {half, first ? half - std::min<size_t>(half, 1) : next, 1};
}

// Cb or Cr of pixel (x, y), halves upwards.
int32_t chroma_at(const uint8_t* plane, size_t width, const Between& x, const Between& y,
                  const VideoLevels& levels) {
  const auto row = [&](size_t at) {
    return (4 - x.far) * sample_at(plane, at * width + x.near_at, levels) +
           x.far * sample_at(plane, at * width + x.far_at, levels);
  };
  return ((4 - y.far) * row(y.near_at) + y.far * row(y.far_at) + 8) >> 4;
}

void store_sample(uint8_t* plane, size_t index, int32_t sample, const VideoLevels& levels) {
  if (levels.bits == 8) {
    plane[index] = static_cast<uint8_t>(sample);
  } else {
    plane[2 * index] = static_cast<uint8_t>(sample & 255);
    plane[2 * index + 1] = static_cast<uint8_t>(sample >> 8);
  }
}

// Y4mReader::note() of a video.
std::string video_note(const Y4mHeader& header) {
  std::string note = header.guessed;
  const auto add = [&](const std::string& text) { note += (note.empty() ? "" : "; ") + text; };
  if (header.chroma.x != ChromaSide::kEach)
    add("Cb and Cr of pixels between samples are interpolated");
  if (!header.note && header.levels.bits > 12) {
    add(fmt::format("samples of {} bits are reduced to 12 bits, the most that a stream holds",
                    header.levels.bits));
  }
  return note;
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
  const int depth = header->note ? header->note->depth : std::min(header->levels.bits, 12);
  video.shape_ = {grid->rows, grid->cols, header->width, header->height, depth};
  const size_t samples = frame_samples(video.shape_, header->chroma);
  auto frames = find_frames(bytes, line->size() + 1, samples * sample_bytes(header->levels));
  const std::string guess = header->guessed.empty() ? "" : " (" + header->guessed + ")";
  if (!frames) return file_error(file, frames.error() + guess);
  if (frames->size() != size_t{grid->rows} * grid->cols) {
    return file_error(file, fmt::format("{} frames, not those of {} x {} views{}", frames->size(),
                                        grid->rows, grid->cols, guess));
  }
  for (size_t i = 0; i < frames->size(); ++i) {
    if (is_in_range(&bytes[(*frames)[i]], samples, header->levels)) continue;
    return file_error(file,
                      fmt::format("unsupported: frame {} has samples of more than the {} bits "
                                  "of the header, such as those in the upper bits of 16 "
                                  "(MSB-aligned); ffmpeg -i ORIGINAL -pix_fmt yuv444p10 "
                                  "-strict -1 OUT.y4m writes the lower ones",
                                  i, header->levels.bits));
  }
  video.order_ = order.value_or(header->note ? header->note->order : FrameOrder::kRaster);
  video.chroma_ = header->chroma;
  video.levels_ = header->levels;
  video.frames_ = std::move(*frames);
  video.note_ = video_note(*header);
  return video;
}

RgbImage Y4mReader::view(uint32_t row, uint32_t col) const {
  const GridShape grid{shape_.rows, shape_.cols};
  const uint8_t* y = file_.bytes().data() + frames_[frame_of_view({row, col}, grid, order_)];
  RgbImage image{shape_.width, shape_.height, shape_.depth, {}};
  const size_t pixels = size_t{image.width} * image.height;
  const uint8_t* cb = y + pixels * sample_bytes(levels_);
  const uint8_t* cr = cb + chroma_samples(shape_, chroma_) * sample_bytes(levels_);
  const size_t width = chroma_length(image.width, chroma_.x);
  const size_t height = chroma_length(image.height, chroma_.y);
  const int32_t grey = 1 << (levels_.bits - 1);
  image.samples.reserve(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    YCbCr coded{sample_at(y, i, levels_), grey, grey};
    if (chroma_.there) {
      const Between across = between(i % image.width, width, chroma_.x);
      const Between down = between(i / image.width, height, chroma_.y);
      coded.cb = chroma_at(cb, width, across, down, levels_);
      coded.cr = chroma_at(cr, width, across, down, levels_);
    }
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
  const std::string line =
      write_y4m_header({shape.width, shape.height, {}, levels, {}, note}) + "\n";
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
  frame.resize(line.size() + 3 * pixels * sample_bytes(levels_));
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
