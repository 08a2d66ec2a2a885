#include "gpu/frame_path.hpp"

#include <algorithm>
#include <cmath>

#include "render/taps.hpp"

namespace hmlfc::gpu {
namespace {

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

std::vector<PixelArea> whole_views(const StreamView& stream, uint64_t views) {
  const PlaneShape& luma = stream.geometry.plane(Plane::kY);
  const uint64_t grid = uint64_t{stream.header.rows} * stream.header.cols;
  std::vector<PixelArea> areas;
  for (uint64_t i = 0; i < views; ++i) {
    const uint64_t view = i * grid / views % grid;
    const ViewPos at{static_cast<uint32_t>(view / stream.header.cols),
                     static_cast<uint32_t>(view % stream.header.cols)};
    areas.push_back({at, 0, 0, luma.blocks_x, luma.blocks_y, 0});
  }
  return areas;
}

}  // namespace hmlfc::gpu
