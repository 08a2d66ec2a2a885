#include "gpu/gpu_speed.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/measuring.hpp"
#include "decode/stage_times.hpp"
#include "decoder/open_stream.hpp"
#include "gpu/frame_check.hpp"
#include "gpu/frame_path.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

using namespace gpu;
using Json = nlohmann::ordered_json;

constexpr uint64_t kCacheBytes = uint64_t{512} << 20;
constexpr uint64_t kMostViews = 16;  // that are decoded, one after the other
constexpr uint64_t kHostFrames = 24;

Json stages_json(std::span<const StageTime> stages, uint64_t pieces) {
  Json json = Json::object();
  for (const auto& stage : stages) {
    json[stage.stage] = 1000 * stage.seconds / static_cast<double>(pieces);
  }
  return json;
}

Json measure_decoding(Device& device, const StreamView& stream, double least_seconds) {
  auto decoder = value_of(GpuDecoder::open(device, stream));
  const uint64_t grid = uint64_t{stream.header.rows} * stream.header.cols;
  const auto views = whole_views(stream, std::min(grid, kMostViews));
  value_of(decoder.decode_rgb({views.data(), 1}));  // makes buffers
  uint64_t decoded = 0;
  double to_host = 0;
  std::vector<StageTime> stages;
  while (to_host < least_seconds) {
    const PixelArea& view = views[decoded++ % views.size()];
    const Clock clock;
    const auto blocks = value_of(decoder.decode_rgb({&view, 1}));
    to_host += clock.wall_seconds();
    if (std::ranges::any_of(blocks.statuses, [](uint8_t status) { return status != 0; })) {
      throw std::runtime_error("a block of the stream does not decode");
    }
    add_times(decoder.stage_times(), stages);
  }
  double on_device = 0;
  for (const StageTime& stage : stages) on_device += stage.seconds;
  const double gigapixels =
      1e-9 * static_cast<double>(decoded * stream.header.width * stream.header.height);
  return {{"views", decoded},
          {"gigapixels_a_second", on_device > 0 ? gigapixels / on_device : 0},
          {"gigapixels_a_second_to_host", gigapixels / to_host},
          {"stage_ms", stages_json(stages, decoded)}};
}

// Draws frames of `records`, in turn: at least `frames` of them, and for at least `seconds`.
// `cold`: nothing is held before any of them. The time of a frame is from the end of the one before
// to its own, so that one that fills the ring first is not measured.
Json draw(GpuRenderer& renderer, std::span<const FrameRecord> records, bool cold, uint64_t frames,
          double seconds) {
  std::vector<double> times;
  std::vector<StageTime> stages;
  GpuFrame frame;
  uint64_t begun = 0, drawn = 0, needed = 0, decoded = 0;
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
    needed += frame.blocks_needed;
    decoded += frame.blocks_decoded;
    add_times(renderer.stage_times(), stages);
    if (++drawn > 1) times.push_back(now - before);
    before = now;
  } while (renderer.under_way() != 0);
  std::ranges::sort(times);
  double sum = 0;
  for (const double time : times) sum += time;
  return {{"frames", drawn},
          {"frames_a_second", static_cast<double>(times.size()) / sum},
          {"frames_a_second_99", 1 / times[(99 * times.size() + 99) / 100 - 1]},
          {"stage_ms", stages_json(stages, drawn)},
          {"blocks_needed", needed},
          {"blocks_decoded", decoded}};
}

// As many of `records` are drawn warm as can be drawn cold in the time of a measurement.
void measure_records(GpuRenderer& renderer, Device& device, std::span<const FrameRecord> records,
                     double seconds, Json& path) {
  draw(renderer, records, true, 1, 0);  // makes buffers
  const Json cold = draw(renderer, records, true, 1, seconds);
  records = records.first(std::min<size_t>(records.size(), cold["frames"]));
  renderer.forget();
  const Json moving = draw(renderer, records, false, records.size(), 0);
  const Json warm = draw(renderer, records, false, 1, seconds);
  records = records.first(std::min<size_t>(kHostFrames, records.size()));
  path["host_us"] = host_microseconds(renderer, records);
  path["recorded_host_us"] = recording_microseconds(renderer, device, records);
  path["cold"] = cold;
  path["moving"] = moving;
  path["warm"] = warm;
}

Json measure_path(Device& device, std::span<const uint8_t> file, const StreamView& stream,
                  const Camera& camera, const GpuPlan& plan) {
  auto renderer = value_of(GpuRenderer::open(device, stream, kCacheBytes));
  const auto checked = value_of(check_frames(renderer, file, stream, camera, 1));
  if (checked.mismatch) throw std::runtime_error("wrong frame: " + *checked.mismatch);
  const auto records = value_of(records_of_path(camera, stream.header, plan.frames));
  const double views = mean_views(records);
  if (stream.header.rows > 1 && stream.header.cols > 1 && views < kLeastViews) {
    throw std::runtime_error(fmt::format(
        "pixels of the frames read only {:.2f} views of the {} that they must, to be worth "
        "measuring",
        views, kLeastViews));
  }
  Json path{{"side", *camera.frame_width},
            {"geometry", camera.geometry == GeometrySource::kStream},
            {"views_a_pixel", views}};
  measure_records(renderer, device, records, plan.seconds, path);
  return path;
}

}  // namespace

Json measure_stream(Device& device, const std::string& name, std::span<const uint8_t> file,
                    const GpuPlan& plan) {
  const StreamView stream = value_of(open_stream(file, {}));
  Json json{{"stream", name}, {"decode", measure_decoding(device, stream, plan.seconds)}};
  for (const uint32_t side : plan.sides) {
    for (const GeometrySource geometry : {GeometrySource::kPlane, GeometrySource::kStream}) {
      Camera camera;
      camera.frame_width = camera.frame_height = side;
      camera.geometry = geometry;
      json["paths"].push_back(measure_path(device, file, stream, camera, plan));
    }
  }
  return json;
}

}  // namespace hmlfc::bench
