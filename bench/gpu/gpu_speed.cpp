#include "gpu/gpu_speed.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <hmlfc/gpu/renderer.hpp>

#include "common/program.hpp"
#include "decoder/open_stream.hpp"
#include "gpu/frame_check.hpp"
#include "gpu/frame_path.hpp"
#include "stage_times.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

using namespace gpu;

constexpr uint64_t kCacheBytes = uint64_t{512} << 20;
constexpr uint64_t kMostViews = 16;  // that are decoded, one after the other
constexpr uint64_t kHostFrames = 24;

DecodeSpeed measure_decoding(Device& device, const StreamView& stream, double seconds) {
  auto decoder = value_of(GpuDecoder::open(device, stream));
  const uint64_t grid = uint64_t{stream.header.rows} * stream.header.cols;
  const auto views = whole_views(stream, std::min(grid, kMostViews));
  value_of(decoder.decode_rgb({views.data(), 1}));  // makes buffers
  DecodeSpeed speed;
  while (speed.seconds < seconds) {
    const PixelArea& view = views[speed.views++ % views.size()];
    const Clock clock;
    const auto blocks = value_of(decoder.decode_rgb({&view, 1}));
    speed.seconds += clock.wall_seconds();
    if (std::ranges::any_of(blocks.statuses, [](uint8_t status) { return status != 0; })) {
      throw std::runtime_error("a block of the stream does not decode");
    }
    add_times(decoder.stage_times(), speed.stages);
  }
  speed.pixels = speed.views * stream.header.width * stream.header.height;
  return speed;
}

// Draws frames of `records`, in turn: at least `frames` of them, and for at least `seconds`.
// `cold`: nothing is held before any of them. The time of a frame is from the end of the one before
// to its own, so that one that fills the ring first is not measured.
FrameSpeed draw(GpuRenderer& renderer, std::span<const FrameRecord> records, bool cold,
                uint64_t frames, double seconds) {
  FrameSpeed speed;
  std::vector<double> times;
  GpuFrame frame;
  uint64_t begun = 0;
  const Clock clock;
  double before = 0;
  const auto wanted = [&] { return begun <= frames || clock.wall_seconds() < seconds; };
  do {
    while (renderer.under_way() < GpuRenderer::most_under_way() && wanted()) {
      if (cold) renderer.forget();
      value_of(renderer.begin(records[begun++ % records.size()], 0, FrameOutput::kDevice));
    }
    value_of(renderer.finish(frame));
    const double now = clock.wall_seconds();
    if (frame.status != ErrorCode::kOk) {
      throw std::runtime_error("a frame has the error " + std::string(error_name(frame.status)));
    }
    speed.needed += frame.blocks_needed;
    speed.decoded += frame.blocks_decoded;
    add_times(renderer.stage_times(), speed.stages);
    if (++speed.frames > 1) times.push_back(now - before);
    before = now;
  } while (renderer.under_way() != 0);
  std::ranges::sort(times);
  double sum = 0;
  for (const double time : times) sum += time;
  speed.frames_a_second = static_cast<double>(times.size()) / sum;
  speed.slow_frames_a_second = 1 / times[(99 * times.size() + 99) / 100 - 1];
  return speed;
}

// As many of `records` are drawn warm as can be drawn cold in the time of a measurement.
void measure_path(GpuRenderer& renderer, Device& device, std::span<const FrameRecord> records,
                  const GpuPlan& plan, PathSpeed& path) {
  draw(renderer, records, true, 1, 0);  // makes buffers
  const auto add = [&](const char* held, bool cold, uint64_t frames, double seconds) {
    path.speeds.push_back(draw(renderer, records, cold, frames, seconds));
    path.speeds.back().held = held;
  };
  add("cold", true, 1, plan.seconds);
  records = records.first(std::min<size_t>(records.size(), path.speeds.front().frames));
  renderer.forget();
  add("moving", false, records.size(), 0);
  add("warm", false, 1, plan.seconds);
  const uint64_t frames = std::min<uint64_t>(kHostFrames, records.size());
  records = records.first(frames);
  path.begun = value_of(measure_host(renderer, device, records, frames));
  path.recorded = value_of(measure_recording(renderer, device, records, frames));
}

PathSpeed measure_path(Device& device, std::span<const uint8_t> file, const StreamView& stream,
                       const Camera& camera, const GpuPlan& plan) {
  PathSpeed path;
  path.side = *camera.frame_width;
  path.geometry = camera.geometry == GeometrySource::kStream;
  auto renderer = value_of(GpuRenderer::open(device, stream, kCacheBytes));
  const auto checked = value_of(check_frames(renderer, file, stream, camera, 1));
  if (checked.mismatch) throw std::runtime_error("wrong frame: " + *checked.mismatch);
  const auto records = value_of(records_of_path(camera, stream.header, plan.frames));
  path.views = mean_views(records);
  if (stream.header.rows > 1 && stream.header.cols > 1 && path.views < kLeastViews) {
    throw std::runtime_error(
        fmt::format("pixels of the frames read only {:.2f} views of the {} "
                    "that they must, to be worth measuring",
                    path.views, kLeastViews));
  }
  measure_path(renderer, device, records, plan, path);
  return path;
}

}  // namespace

StreamSpeed measure_stream(Device& device, std::string name, std::span<const uint8_t> file,
                           const GpuPlan& plan) {
  const StreamView stream = value_of(open_stream(file, {}));
  StreamSpeed speed{std::move(name), measure_decoding(device, stream, plan.seconds)};
  for (const uint32_t side : plan.sides) {
    for (const GeometrySource geometry : {GeometrySource::kPlane, GeometrySource::kStream}) {
      Camera camera;
      camera.frame_width = camera.frame_height = side;
      camera.geometry = geometry;
      speed.paths.push_back(measure_path(device, file, stream, camera, plan));
    }
  }
  return speed;
}

double device_seconds(std::span<const StageTime> stages) {
  double seconds = 0;
  for (const StageTime& stage : stages) seconds += stage.seconds;
  return seconds;
}

}  // namespace hmlfc::bench
