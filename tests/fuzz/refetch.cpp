// Decoder and renderers on a source whose bytes change when they are fetched again, with a cache so
// small that every request fetches.
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/disparity.hpp>
#include <hmlfc/focus.hpp>
#include <hmlfc/renderer.hpp>

#include "bits/crc32c.hpp"
#include "support/changing_source.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr uint64_t kMaxSamples = 1u << 14;  // of a view
constexpr uint64_t kMaxViews = 64;
constexpr uint32_t kFrameSide = 24;

template <class Value>
void check(const Result<Value>& result, size_t file_size) {
  if (!result) demand(result.error().offset <= file_size, "an error past the end of the file");
}

void draw(const Decoder& decoder, FrameRenderer& renderer, GeometrySource geometry, size_t size) {
  Camera camera;
  camera.position = WorldPoint{decoder.header().cols * 0.4, decoder.header().rows * 0.6, -0.5};
  camera.frame_width = camera.frame_height = kFrameSide;
  camera.geometry = geometry;
  const auto record = frame_record(camera, decoder.header());
  if (!record) return;
  Frame frame;
  check(renderer.render(*record, 0, frame), size);
}

void ask(const Decoder& decoder, ViewPos view, size_t size) {
  for (const Plane plane : kPlanes) {
    check(decoder.decode_block({view, plane, 0, 0}), size);
    check(decoder.decode_block({view, plane, 0, 0}, {.references = ReferenceMode::kSparse}), size);
    check(decoder.decode_rect(view, plane, {0, 0, 1, 1}, 0), size);
  }
  check(decoder.decode_view(view), size);
  check(disparity_map(decoder, view), size);
  check(focus_at(decoder, Camera{}, 0, 0), size);
}

}  // namespace

void run(std::span<const uint8_t> input) {
  const uint32_t seed = crc32c(input);
  test::ChangingSource source({input.begin(), input.end()}, seed, 1u << seed % 8);
  OpenOptions options;
  options.check_sections = (seed & 256) != 0;
  options.limits.max_plane_samples = kMaxSamples;
  if ((seed & 512) != 0) source.lie();
  const auto decoder = Decoder::open(source, options);
  if (!decoder) return;
  source.lie();
  const StreamHeader& header = decoder->header();
  if (uint64_t{header.rows} * header.cols > kMaxViews) return;
  check(decoder->statistics(), input.size());
  const auto golden = make_golden_renderer(*decoder);
  const auto fast = make_cpu_renderer(*decoder);
  for (uint32_t row = 0; row < header.rows; ++row) {
    ask(*decoder, {row, (row + seed) % header.cols}, input.size());
    draw(*decoder, *golden, GeometrySource::kPlane, input.size());
    draw(*decoder, *fast, GeometrySource::kStream, input.size());
  }
  check(decoder->load_references(1), input.size());
}

std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  return {{stream.begin(), stream.end()}};
}

}  // namespace hmlfc::fuzz
