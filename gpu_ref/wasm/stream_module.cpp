// A stream in a browser: what its pages need besides the kernels in WGSL. One stream an instance of
// the module.
//
// A call returns an error of annex A, kOk, or kMissing: the answer then is ranges of the file,
// offset and bytes, that the page loads before it calls again. Answers are words of 32 bits that
// stay until the next call.
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "arithmetic/rounding.hpp"
#include "chunked_file.hpp"
#include "decode/stream_shape.hpp"
#include "decoder/key_images.hpp"
#include "decoder/open_stream.hpp"
#include "device/arguments.hpp"
#include "frame_needs.hpp"
#include "render/block_disparity.hpp"
#include "render/find_focus.hpp"

#define HMLFC_CALL(name) extern "C" __attribute__((export_name(#name)))

namespace hmlfc::gpu {
namespace {

constexpr int kOk = 0;
constexpr int kMissing = -1;
constexpr int kBadCamera = -2;      // the answer is text
constexpr uint32_t kNoChunks = 31;  // log2 of words that no buffer has

std::unique_ptr<ChunkedFile> file;
std::optional<StreamView> stream;
std::vector<uint32_t> words;

// A camera as the page gives it; the rest is that of with_defaults.
struct {
  double width, height, u, v, z, at_u, at_v, at_z, focus, aperture, filter, geometry;
} inputs;

void add(uint64_t word) { words.push_back(static_cast<uint32_t>(word)); }

template <class Record>
void add_record(const Record& record) {
  const auto* begin = reinterpret_cast<const uint32_t*>(&record);
  words.insert(words.end(), begin, begin + sizeof(Record) / 4);
}

// Whether reads have missed bytes, which are then the answer.
bool has_missed() {
  const auto missing = file->take_missing();
  if (missing.empty()) return false;
  words.clear();
  for (const ByteRange& range : missing) {
    add(range.offset);
    add(range.bytes);
  }
  return true;
}

int end(ErrorCode code) { return has_missed() ? kMissing : static_cast<int>(code); }

// The facts that the page knows by their place (FACTS of stream_client.js), then the shape.
void add_facts() {
  const StreamHeader& header = stream->header;
  const PlaneShape& luma = stream->geometry.plane(Plane::kY);
  const ByteRange coded = coded_range(*stream);
  uint64_t blocks = 0;
  for (const Plane p : kPlanes) {
    blocks += uint64_t{stream->geometry.plane(p).blocks_x} * stream->geometry.plane(p).blocks_y;
  }
  const auto area = 4 * reference_count(stream->geometry) * reference_words(stream->geometry);
  for (const uint64_t fact :
       {uint64_t{header.rows}, uint64_t{header.cols}, uint64_t{header.width},
        uint64_t{header.height}, static_cast<uint64_t>(header.depth), uint64_t{header.block_log2},
        static_cast<uint64_t>(header.tree_height) + 1,
        uint64_t{header.chroma_format == ChromaFormat::k420}, uint64_t{luma.blocks_x},
        uint64_t{luma.blocks_y}, coded.offset, coded.bytes, stream->entry(Section::kRoot).size,
        area, blocks * stream->geometry.level(0).images(),
        static_cast<uint64_t>(suitable_geometry(header))}) {
    add(std::min<uint64_t>(fact, UINT32_MAX));
  }
  add_record(stream_shape(*stream, kNoChunks, kNoChunks));
}

Camera camera_of_inputs() {
  Camera camera;
  camera.frame_width = static_cast<uint32_t>(inputs.width);
  camera.frame_height = static_cast<uint32_t>(inputs.height);
  camera.position = {inputs.u, inputs.v, inputs.z};
  camera.look_at = {inputs.at_u, inputs.at_v, inputs.at_z};
  camera.focus = inputs.focus;
  camera.aperture = static_cast<int>(inputs.aperture);
  camera.filter = static_cast<Filter>(static_cast<int>(inputs.filter));
  camera.geometry = static_cast<GeometrySource>(static_cast<int>(inputs.geometry));
  return camera;
}

void add_images(const std::set<TreeImage>& images) {
  add(images.size());
  for (const TreeImage& image : images) {
    add(static_cast<uint64_t>(image.level));
    add(image.at.row);
    add(image.at.col);
  }
}

}  // namespace

/// Where the file of `bytes` bytes belongs; null where there is no memory for it.
HMLFC_CALL(reserve) uint8_t* hmlfc_reserve(uint32_t bytes) {
  file = std::make_unique<ChunkedFile>(bytes);
  return file->room();
}

HMLFC_CALL(set_loaded) void hmlfc_set_loaded(uint32_t offset) { file->set_loaded(offset); }
HMLFC_CALL(answer) const uint32_t* hmlfc_answer() { return words.data(); }
HMLFC_CALL(answer_words) uint32_t hmlfc_answer_words() {
  return static_cast<uint32_t>(words.size());
}
HMLFC_CALL(camera_inputs) double* hmlfc_camera_inputs() { return &inputs.width; }

/// Opens the stream. The answer: facts and shape.
HMLFC_CALL(open) int hmlfc_open() {
  words.clear();
  auto opened = open_stream(*file, {.check_sections = false});
  if (!opened) return end(opened.error().code);
  stream = std::move(*opened);
  const SectionEntry& root = stream->entry(Section::kRoot);
  if (!is_loaded(*file, {root.offset, root.size})) return end(ErrorCode::kBusError);
  add_facts();
  return kOk;
}

/// The answer: the frame record of the inputs, then the views in use.
HMLFC_CALL(frame_record) int hmlfc_frame_record() {
  words.clear();
  const auto record = frame_record(camera_of_inputs(), stream->header);
  if (!record) {
    for (const char c : record.error().message) add(static_cast<uint8_t>(c));
    return kBadCamera;
  }
  add_record(*record);
  for (const int view : views_in_use(*record)) add(static_cast<uint64_t>(view));
  return kOk;
}

/// The answer: key images, other reference images, each with their number before them and three
/// words each; then ranges of the file.
HMLFC_CALL(frame_needs)
int hmlfc_frame_needs(uint32_t row0, uint32_t row1, uint32_t col0, uint32_t col1, int stop_level) {
  words.clear();
  const auto needs = frame_needs(*stream, {row0, row1}, {col0, col1}, stop_level);
  if (!needs) return end(needs.error().code);
  add_images(needs->keys);
  add_images(needs->references);
  for (const ByteRange& range : needs->ranges) {
    add(range.offset);
    add(range.bytes);
  }
  return kOk;
}

/// Decodes a plane of a key image. The answer: its error, its first word in the reference area, its
/// words there.
HMLFC_CALL(key_plane) int hmlfc_key_plane(int level, uint32_t row, uint32_t col, uint32_t p) {
  words.clear();
  const auto plane = static_cast<Plane>(p);
  const Geometry& geometry = stream->geometry;
  const KeyImages keys(*stream);
  const auto samples = keys.plane(level, {row, col}, plane);
  if (has_missed()) return kMissing;
  const StreamShapeRecord shape = stream_shape(*stream, kNoChunks, kNoChunks);
  const LevelShape& images = geometry.level(level);
  const ImagePos group = geometry.group_of(level, {row, col});
  const uint64_t number = shape.levels[static_cast<size_t>(level)].first_reference +
                          uint64_t{group.row} * images.group_cols() + group.col;
  const PlaneShapeRecord& size = shape.planes[p];
  add(samples ? 0 : static_cast<uint64_t>(samples.error().code));
  add(number * shape.reference_words + size.first_word);
  const int32_t fill = samples ? 0 : kErrorSample + static_cast<int32_t>(samples.error().code);
  for (uint32_t y = 0; y < size.height; ++y) {
    std::vector<int16_t> line(2 * size_t{size.row_words}, static_cast<int16_t>(fill));
    if (samples) std::ranges::copy((*samples)->row(y), line.begin());
    for (uint32_t x = 0; x < size.row_words; ++x) {
      add(static_cast<uint16_t>(line[2 * x]) | uint32_t{static_cast<uint16_t>(line[2 * x + 1])}
                                                   << 16);
    }
  }
  return kOk;
}

/// The answer: the disparities of a view as surface.comp reads them (SRF-3).
HMLFC_CALL(disparities) int hmlfc_disparities(uint32_t row, uint32_t col) {
  words.clear();
  const uint32_t rows = stream->geometry.plane(Plane::kY).blocks_y;
  const auto told = disparity_rows(*stream, {row, col}, 0, rows);
  if (has_missed()) return kMissing;
  for (const BlockDisparity& one : told) {
    add(static_cast<uint16_t>(one.disparity) | (one.confidence == 0 ? 0u : 1u << 16));
  }
  return kOk;
}

/// What pixel (x, y) of the frame of the inputs shows. The answer: a PixelSight, the disparity.
HMLFC_CALL(focus) int hmlfc_focus(uint32_t x, uint32_t y) {
  words.clear();
  const auto found = find_focus(*stream, camera_of_inputs(), x, y);
  if (has_missed()) return kMissing;
  if (!found) return static_cast<int>(found.error().code);
  add(static_cast<uint64_t>(found->sight));
  add(static_cast<uint64_t>(int64_t{found->disparity}));
  return kOk;
}

}  // namespace hmlfc::gpu
