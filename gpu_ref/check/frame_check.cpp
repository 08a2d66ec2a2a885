#include "frame_check.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include <hmlfc/renderer.hpp>

namespace hmlfc::gpu {
namespace {

using Clock = std::chrono::steady_clock;

// The camera of frame `i` of `frames`.
Camera moved(Camera camera, const StreamHeader& header, uint64_t i, uint64_t frames) {
  const double part = frames <= 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(frames - 1);
  camera.position = WorldPoint{part * (header.cols - 1), 0.5 * (header.rows - 1), 0};
  return camera;
}

void add_stages(const std::vector<StageTime>& times, std::vector<StageTime>& sums) {
  if (sums.empty()) {
    sums = times;
    return;
  }
  for (size_t i = 0; i < times.size() && i < sums.size(); ++i) sums[i].seconds += times[i].seconds;
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

}  // namespace

Outcome<FrameReport> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                  const StreamView& stream, const Camera& camera, uint64_t frames,
                                  bool compare) {
  OpenOptions options;
  options.check_sections = false;
  const auto decoder = Decoder::open(file, options);
  if (!decoder) return tl::unexpected(Failure{to_string(decoder.error())});
  const auto golden = make_golden_renderer(*decoder);
  FrameReport report;
  for (uint64_t i = 0; i <= frames; ++i) {
    const uint64_t number = i == 0 ? 0 : i - 1;
    const auto record = frame_record(moved(camera, stream.header, number, frames), stream.header);
    if (!record) return tl::unexpected(Failure{record.error().message});
    const auto begin = Clock::now();
    const auto frame = renderer.render(*record, 0);
    if (!frame) return tl::unexpected(frame.error());
    if (i == 0) continue;  // makes pipelines and buffers
    report.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    ++report.frames;
    report.width = static_cast<uint32_t>(record->frame_width);
    report.height = static_cast<uint32_t>(record->frame_height);
    report.blocks += frame->blocks_needed;
    add_stages(renderer.stage_times(), report.stages);
    if (!compare) continue;
    Frame expected;
    const auto drawn = golden->render(*record, 0, expected);
    if (const auto found = difference(drawn, expected, *frame)) {
      report.mismatch = fmt::format("frame {} of {}: {}", number, frames, *found);
      break;
    }
  }
  return report;
}

std::string to_text(const FrameReport& report) {
  const auto frames = static_cast<double>(std::max<uint64_t>(report.frames, 1));
  std::string text = fmt::format("{} frames of {} x {} pixels, {} blocks decoded\n", report.frames,
                                 report.width, report.height, report.blocks);
  double device = 0;
  for (const StageTime& stage : report.stages) {
    text +=
        fmt::format("  {:<10} {:10.3f} ms a frame\n", stage.stage, 1000 * stage.seconds / frames);
    device += stage.seconds;
  }
  if (!report.stages.empty()) {
    text += fmt::format("  {:<10} {:10.3f} ms a frame, {:.1f} frames a second\n", "device",
                        1000 * device / frames, frames / device);
  }
  text += fmt::format("  {:<10} {:10.3f} ms a frame\n", "call", 1000 * report.seconds / frames);
  if (report.mismatch) text += "MISMATCH: " + *report.mismatch + "\n";
  return text;
}

}  // namespace hmlfc::gpu
