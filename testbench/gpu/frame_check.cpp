#include "gpu/frame_check.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <hmlfc/renderer.hpp>

#include "gpu/frame_path.hpp"

namespace hmlfc::gpu {
namespace {

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

Outcome<FrameCheck> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                 const StreamView& stream, const Camera& camera, uint64_t frames) {
  OpenOptions options;
  options.check_sections = false;
  const auto decoder = Decoder::open(file, options);
  if (!decoder) return tl::unexpected(Failure{FailureKind::kUnusable, to_string(decoder.error())});
  const auto golden = make_golden_renderer(*decoder);
  const auto records = records_of_path(camera, stream.header, frames);
  if (!records) return tl::unexpected(records.error());
  FrameCheck check;
  for (const FrameRecord& record : *records) {
    const auto frame = renderer.render(record, 0);
    if (!frame) return tl::unexpected(frame.error());
    ++check.frames;
    check.needed += frame->blocks_needed;
    check.decoded += frame->blocks_decoded;
    Frame expected;
    const auto drawn = golden->render(record, 0, expected);
    if (const auto found = difference(drawn, expected, *frame)) {
      check.mismatch = fmt::format("frame {} of {}: {}", check.frames - 1, frames, *found);
      break;
    }
  }
  return check;
}

}  // namespace hmlfc::gpu
