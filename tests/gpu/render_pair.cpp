#include "gpu/render_pair.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "decoder/open_stream.hpp"
#include "render/displaced_cells.hpp"

namespace hmlfc::gpu {
namespace {

OpenOptions unchecked() {
  OpenOptions options;
  options.check_sections = false;
  return options;
}

std::string differs(const std::string& what, uint64_t expected, uint64_t actual) {
  return what + ": expected " + std::to_string(expected) + ", actual " + std::to_string(actual);
}

// What differs between two pictures, or nothing.
std::string image_difference(const RgbImage& expected, const RgbImage& actual) {
  if (expected.width != actual.width) return differs("width", expected.width, actual.width);
  if (expected.height != actual.height) return differs("height", expected.height, actual.height);
  if (expected.depth != actual.depth) return "depth";
  const auto found = std::ranges::mismatch(expected.samples, actual.samples);
  if (found.in1 == expected.samples.end() && found.in2 == actual.samples.end()) return {};
  const auto at = found.in1 - expected.samples.begin();
  return "sample " + std::to_string(at) + " of " + std::to_string(expected.samples.size());
}

}  // namespace

RenderPair::RenderPair(Device& device, std::vector<uint8_t> bytes, uint64_t cache_bytes)
    : stream_(std::move(bytes), unchecked()), view_(open_stream(stream_.bytes, unchecked())) {
  if (!stream_.decoder || !view_) return;
  golden_ = make_golden_renderer(*stream_.decoder);
  auto opened = GpuRenderer::open(device, *view_, cache_bytes);
  if (!opened) {
    ADD_FAILURE() << opened.error().message;
    return;
  }
  gpu_.emplace(std::move(*opened));
  model_.emplace(*view_, cache_bytes);
}

std::string RenderPair::difference(const FrameRecord& record, int stop_level, FrameTally& tally) {
  Frame expected;
  const auto golden = golden_->render(record, stop_level, expected);
  auto actual = gpu_->render(record, stop_level);
  if (!actual) return actual.error().message;
  last_ = std::move(*actual);
  ++tally.frames;
  if (stop_level > 0) ++tally.coarse;
  if (last_.submissions > 1) ++tally.repeated;
  const ErrorCode status = golden ? ErrorCode::kOk : golden.error().code;
  if (last_.status != status) {
    return std::string("status: expected ") + std::string(error_name(status)) + ", actual " +
           std::string(error_name(last_.status));
  }
  if (!golden) {
    ++tally.failed;
    if (status != ErrorCode::kBadRequest) model_->forget();
    return {};
  }
  if (auto found = image_difference(expected.image, last_.image); !found.empty()) return found;
  const auto displaced = golden_displacements(*stream_.decoder, record, stop_level);
  if (std::ranges::any_of(displaced.cells, [](int32_t e) { return e != 0; })) ++tally.displaced;
  const uint64_t decoded = model_->take(record, stop_level, displaced);
  if (last_.blocks_needed != expected.counts.blocks_needed) {
    return differs("blocks needed", expected.counts.blocks_needed, last_.blocks_needed);
  }
  if (last_.blocks_decoded != decoded) {
    return differs("blocks decoded", decoded, last_.blocks_decoded);
  }
  if (last_.disparities_looked_up != expected.counts.disparities_looked_up) {
    return differs("disparities looked up", expected.counts.disparities_looked_up,
                   last_.disparities_looked_up);
  }
  tally.needed += last_.blocks_needed;
  tally.decoded += last_.blocks_decoded;
  const auto& samples = expected.image.samples;
  if (std::ranges::any_of(samples, [](uint16_t sample) { return sample != 0; })) ++tally.lit;
  return {};
}

void RenderPair::compare(const FrameRecord& record, int stop_level, FrameTally& tally) {
  EXPECT_EQ(difference(record, stop_level, tally), "");
}

}  // namespace hmlfc::gpu
