// How far frames of random cameras are from real frames (ERR-1, SRF-6).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <hmlfc/renderer.hpp>

#include "render/ray.hpp"
#include "render/render_cases.hpp"

namespace hmlfc {
namespace {

/// Sums over the samples compared: those of pixels that are inside in both frames.
struct Errors {
  int displaced = 0;  ///< frames in which geometry displaces a cell
  uint64_t samples = 0;
  double worst = 0;  ///< the largest error, in parts of its bound
};

/// Adds the samples of one camera.
void add_errors(const Decoder& decoder, const Camera& camera, int stop_level, Errors& errors) {
  const FrameRecord record = *frame_record(camera, decoder.header());
  Frame frame;
  ASSERT_TRUE(make_golden_renderer(decoder)->render(record, stop_level, frame).has_value());
  const auto real = render_real(decoder, camera, stop_level);
  ASSERT_TRUE(real.has_value());
  const double bound = fixed_point_bound(camera, decoder.header(), real->max_displacement);
  for (size_t i = 0; i < real->samples.size(); ++i) {
    const auto pixel = static_cast<int32_t>(i / 3);
    const bool inside =
        trace(record, pixel % record.frame_width, pixel / record.frame_width).has_value();
    if (!inside || real->inside[i / 3] == 0) continue;
    const double part = std::abs(frame.image.samples[i] - real->samples[i]) / bound;
    ASSERT_LE(part, 1) << "sample " << i;
    errors.worst = std::max(errors.worst, part);
    ++errors.samples;
  }
  errors.displaced += real->max_displacement > 0 ? 1 : 0;
}

// 300 cameras with filter quadrilinear, every other one with geometry.
TEST(FixedPoint, StaysWithinTheBoundOfTheRealFrame) {
  Errors errors;
  for (uint32_t seed = 0; seed < 75; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    test::Random random(seed);
    for (int n = 0; n < 4; ++n) {
      Camera camera = test::random_camera(random, stream.decoder->header());
      camera.filter = Filter::kQuadrilinear;
      if (n % 2 == 1) camera.geometry = GeometrySource::kStream;
      const int levels = stream.decoder->header().tree_height + 1;
      const int level = n % 4 == 2 ? static_cast<int>(random() % static_cast<uint32_t>(levels)) : 0;
      ASSERT_NO_FATAL_FAILURE(add_errors(*stream.decoder, camera, level, errors))
          << "stream " << seed << ", camera " << n;
    }
  }
  EXPECT_GT(errors.displaced, 20);
  EXPECT_GT(errors.samples, 100000u);
  EXPECT_GT(errors.worst, 0.1) << "the bound is far above what occurs";
}

}  // namespace
}  // namespace hmlfc
