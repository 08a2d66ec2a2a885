// How far frames of random cameras are from real frames, in parts of their bound (ERR-1, SRF-6).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include <hmlfc/renderer.hpp>

#include "render/ray.hpp"
#include "render/render_cases.hpp"

namespace hmlfc::test {

/// Of all samples compared: those of pixels that are inside in both frames.
struct FixedPointErrors {
  int cameras = 0;
  int displaced = 0;  ///< frames in which geometry displaces a cell
  uint64_t samples = 0;
  double worst = 0;      ///< the largest error, in parts of its bound
  std::string worst_at;  ///< its stream, camera and sample
};

/// Adds the samples of one camera, described by `name`; `change` may change its record.
inline void add_errors(const Decoder& decoder, const Camera& camera, int stop_level,
                       const std::string& name, const std::function<void(FrameRecord&)>& change,
                       FixedPointErrors& errors) {
  FrameRecord record = *frame_record(camera, decoder.header());
  if (change) change(record);
  Frame frame;
  const auto drawn = make_golden_renderer(decoder)->render(record, stop_level, frame);
  const auto real = render_real(decoder, camera, stop_level);
  if (!drawn || !real) {
    errors.worst = INFINITY;
    errors.worst_at = name + ": no frame";
    return;
  }
  const double bound = fixed_point_bound(camera, decoder.header(), real->max_displacement);
  for (size_t i = 0; i < real->samples.size(); ++i) {
    const auto pixel = static_cast<int32_t>(i / 3);
    const bool inside =
        trace(record, pixel % record.frame_width, pixel / record.frame_width).has_value();
    if (!inside || real->inside[i / 3] == 0) continue;
    const double part = std::abs(frame.image.samples[i] - real->samples[i]) / bound;
    if (part > errors.worst) {
      errors.worst = part;
      errors.worst_at = name + ", sample " + std::to_string(i);
    }
    ++errors.samples;
  }
  ++errors.cameras;
  errors.displaced += real->max_displacement > 0 ? 1 : 0;
}

/// The errors of `cameras` random cameras in each of `streams` random streams from `first_seed` on,
/// with filter quadrilinear, every other one with geometry. `change` may change their records.
inline FixedPointErrors fixed_point_errors(uint32_t first_seed, uint32_t streams, int cameras,
                                           const std::function<void(FrameRecord&)>& change = {}) {
  FixedPointErrors errors;
  for (uint32_t seed = first_seed; seed < first_seed + streams; ++seed) {
    const OpenedStream stream(random_stream(seed));
    Random random(seed);
    for (int n = 0; n < cameras; ++n) {
      Camera camera = random_camera(random, stream.decoder->header());
      camera.filter = Filter::kQuadrilinear;
      if (n % 2 == 1) camera.geometry = GeometrySource::kStream;
      const int levels = stream.decoder->header().tree_height + 1;
      const int level = n % 4 == 2 ? static_cast<int>(random() % static_cast<uint32_t>(levels)) : 0;
      add_errors(*stream.decoder, camera, level,
                 "stream " + std::to_string(seed) + ", camera " + std::to_string(n), change,
                 errors);
    }
  }
  return errors;
}

}  // namespace hmlfc::test
