#include "gpu/frame_check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <hmlfc/renderer.hpp>

#include "gpu/speed.hpp"
#include "render/taps.hpp"
#include "stage_times.hpp"

namespace hmlfc::gpu {
namespace {

using Clock = std::chrono::steady_clock;

// Every so many pixels of a frame, in both directions, are asked which views they read.
constexpr int32_t kPixelStep = 8;

// Place `part`, in [0, 1], of the way along `views` views, in the middle half between two of them.
double between_views(double part, uint32_t views) {
  if (views <= 1) return 0;
  const double place = part * (views - 1);
  const double first = std::min(std::floor(place), views - 2.0);
  return first + 0.25 + 0.5 * (place - first);
}

// The camera of frame `i` of `frames`.
Camera moved(Camera camera, const StreamHeader& header, uint64_t i, uint64_t frames) {
  const double part = frames <= 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(frames - 1);
  camera.position =
      WorldPoint{between_views(part, header.cols), between_views(0.5, header.rows), 0};
  return camera;
}

// What differs between two frames, or nothing.
std::optional<std::string> difference(const Result<void>& golden, const Frame& expected,
                                      const GpuFrame& actual) {
  const ErrorCode status = golden ? ErrorCode::kOk : golden.error().code;
  if (status != actual.status) {
    return fmt::format("status: expected {}, actual {}", error_name(status),
                       error_name(actual.status));
  }
  if (!golden) return std::nullopt;
  if (expected.counts.blocks_needed != actual.blocks_needed) {
    return fmt::format("blocks needed: expected {}, actual {}", expected.counts.blocks_needed,
                       actual.blocks_needed);
  }
  const auto& samples = expected.image.samples;
  const auto found = std::mismatch(samples.begin(), samples.end(), actual.image.samples.begin(),
                                   actual.image.samples.end());
  if (found.first == samples.end()) return std::nullopt;
  const auto at = static_cast<size_t>(found.first - samples.begin());
  return fmt::format("pixel ({}, {}) channel {}: expected {}, actual {}",
                     at / 3 % expected.image.width, at / 3 / expected.image.width, at % 3,
                     *found.first, *found.second);
}

// Renders a frame of `path` and counts what it took.
Outcome<GpuFrame> add_frame(GpuRenderer& renderer, const FrameRecord& record, FramePath& path) {
  const auto begin = Clock::now();
  auto frame = renderer.render(record, 0);
  if (!frame) return frame;
  path.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
  ++path.frames;
  path.width = static_cast<uint32_t>(record.frame_width);
  path.height = static_cast<uint32_t>(record.frame_height);
  path.needed += frame->blocks_needed;
  path.decoded += frame->blocks_decoded;
  add_times(renderer.stage_times(), path.stages);
  return frame;
}

}  // namespace

Outcome<std::vector<FrameRecord>> records_of_path(const Camera& camera, const StreamHeader& header,
                                                  uint64_t frames) {
  std::vector<FrameRecord> records;
  for (uint64_t i = 0; i < frames; ++i) {
    const auto record = frame_record(moved(camera, header, i, frames), header);
    if (!record) return tl::unexpected(Failure{FailureKind::kUnusable, record.error().message});
    records.push_back(*record);
  }
  return records;
}

double mean_views(std::span<const FrameRecord> records) {
  uint64_t pixels = 0;
  uint64_t views = 0;
  for (const FrameRecord& record : records) {
    for (int32_t j = 0; j < record.frame_height; j += kPixelStep) {
      for (int32_t i = 0; i < record.frame_width; i += kPixelStep) {
        const auto ray = trace(record, i, j);
        if (!ray) continue;
        ++pixels;
        for_each_view_taps(record, *ray, 0, [&](const ViewTaps&) { ++views; });
      }
    }
  }
  return static_cast<double>(views) / static_cast<double>(std::max<uint64_t>(pixels, 1));
}

Outcome<FramePath> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                const StreamView& stream, const Camera& camera, uint64_t frames) {
  OpenOptions options;
  options.check_sections = false;
  const auto decoder = Decoder::open(file, options);
  if (!decoder) return tl::unexpected(Failure{FailureKind::kUnusable, to_string(decoder.error())});
  const auto golden = make_golden_renderer(*decoder);
  const auto records = records_of_path(camera, stream.header, frames);
  if (!records) return tl::unexpected(records.error());
  FramePath path;
  for (const FrameRecord& record : *records) {
    const auto frame = add_frame(renderer, record, path);
    if (!frame) return tl::unexpected(frame.error());
    Frame expected;
    const auto drawn = golden->render(record, 0, expected);
    if (const auto found = difference(drawn, expected, *frame)) {
      path.mismatch = fmt::format("frame {} of {}: {}", path.frames - 1, frames, *found);
      break;
    }
  }
  return path;
}

Outcome<FrameSpeed> measure_frames(GpuRenderer& renderer, const StreamView& stream,
                                   const Camera& camera, uint64_t frames) {
  const auto records = records_of_path(camera, stream.header, frames);
  if (!records) return tl::unexpected(records.error());
  FramePath unused;
  if (const auto first = add_frame(renderer, records->front(), unused); !first) {
    return tl::unexpected(first.error());
  }
  renderer.forget();
  FrameSpeed speed;
  speed.views = mean_views(*records);
  for (FramePath* path : {&speed.cold, &speed.warm}) {
    for (const FrameRecord& record : *records) {
      const auto frame = add_frame(renderer, record, *path);
      if (!frame) return tl::unexpected(frame.error());
    }
  }
  return speed;
}

std::string to_text(const FramePath& path) {
  const auto frames = static_cast<double>(std::max<uint64_t>(path.frames, 1));
  std::string text = fmt::format("{} frames of {} x {} pixels, {} blocks needed, {} decoded\n",
                                 path.frames, path.width, path.height, path.needed, path.decoded);
  text += stage_text(path.stages, path.frames, "frame");
  if (!path.stages.empty()) {
    const double device = device_seconds(path.stages);
    text += fmt::format("  {:<10} {:10.3f} ms a frame, {:.1f} frames a second\n", "device",
                        1000 * device / frames, frames / device);
  }
  text += fmt::format("  {:<10} {:10.3f} ms a frame\n", "call", 1000 * path.seconds / frames);
  if (path.mismatch) text += "MISMATCH: " + *path.mismatch + "\n";
  return text;
}

}  // namespace hmlfc::gpu
