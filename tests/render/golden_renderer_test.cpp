// The golden renderer against the real frame, and where it must be exact.
#include <gtest/gtest.h>

#include <cmath>

#include <hmlfc/renderer.hpp>

#include "render/render_cases.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

Frame golden_frame(const Decoder& decoder, const Camera& camera, int stop_level = 0) {
  const auto record = frame_record(camera, decoder.header());
  EXPECT_TRUE(record.has_value()) << (record ? "" : record.error().message);
  Frame frame;
  if (record) {
    EXPECT_TRUE(make_golden_renderer(decoder)->render(*record, stop_level, frame).has_value());
  }
  return frame;
}

// SMP-4, at every view, level and filter.
TEST(GoldenRenderer, AtAPlaceOfTheGridItTakesTheView) {
  for (uint32_t seed = 0; seed < 24; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    const Decoder& decoder = *stream.decoder;
    const StreamHeader& header = decoder.header();
    test::Random random(seed);
    for (int filter = 0; filter < 3; ++filter) {
      Camera camera;
      camera.filter = static_cast<Filter>(filter);
      camera.focus = random() % 2 == 0 ? 0 : 1.75;
      camera.geometry = static_cast<GeometrySource>(random() % 2);
      const ViewPos view{random() % header.rows, random() % header.cols};
      camera.position = {static_cast<double>(view.col), static_cast<double>(view.row), 0};
      const int level = static_cast<int>(random() % static_cast<uint32_t>(header.tree_height + 1));
      const Frame frame = golden_frame(decoder, camera, level);
      const auto decoded = decoder.decode_view(view, level);
      EXPECT_EQ(frame.image.depth, decoded->depth);
      EXPECT_EQ(frame.image.samples, decoded->samples) << "seed " << seed;
    }
  }
}

// SMP-4 for the largest views: record and rays alone, without samples.
TEST(GoldenRenderer, RaysOfAPlaceOfTheGridMeetPixelsExactly) {
  StreamHeader header;
  header.rows = 3;
  header.cols = 4096;
  for (const uint32_t side : {1u, 2u, 255u, 1023u, 2048u, 4095u, 4096u}) {
    header.width = side;
    header.height = (side + 1) / 2;
    Camera camera;
    camera.position = {4095, 1, 0};
    const auto record = frame_record(camera, header);
    ASSERT_TRUE(record.has_value()) << record.error().message;
    for (uint32_t i = 0; i < side; ++i) {
      const auto ray = trace(*record, static_cast<int32_t>(i), 0);
      ASSERT_TRUE(ray.has_value()) << side << " " << i;
      ASSERT_EQ(ray->u, 4095 << 16);
      const AxisTaps taps =
          axis_taps(*record, x_in_view(*record, ray->xb, 4095), static_cast<int32_t>(side));
      ASSERT_EQ(taps.first, static_cast<int32_t>(i)) << side;
      ASSERT_EQ(taps.fraction, 0) << side << " " << i;
    }
  }
}

// ERR-1.
TEST(GoldenRenderer, StaysWithinTheBoundOfTheRealFrame) {
  double worst_part = 0;
  uint64_t compared = 0;
  int displaced = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    const Decoder& decoder = *stream.decoder;
    test::Random random(seed);
    for (int n = 0; n < 4; ++n) {
      Camera camera = test::random_camera(random, decoder.header());
      camera.filter = Filter::kQuadrilinear;
      if (n % 2 == 1) camera.geometry = GeometrySource::kStream;
      const Frame frame = golden_frame(decoder, camera);
      const auto real = render_real(decoder, camera, 0);
      ASSERT_TRUE(real.has_value());
      displaced += real->max_displacement > 0 ? 1 : 0;
      const double bound = fixed_point_bound(camera, decoder.header(), real->max_displacement);
      for (size_t i = 0; i < real->samples.size(); ++i) {
        const auto record = *frame_record(camera, decoder.header());
        const auto pixel = static_cast<int32_t>(i / 3);
        const bool inside =
            trace(record, pixel % record.frame_width, pixel / record.frame_width).has_value();
        if (!inside || real->inside[i / 3] == 0) continue;
        const double error = std::abs(frame.image.samples[i] - real->samples[i]);
        ASSERT_LE(error, bound) << "seed " << seed << ", sample " << i;
        worst_part = std::max(worst_part, error / bound);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100000u);
  EXPECT_GT(displaced, 20);
  EXPECT_GT(worst_part, 0.1) << "the bound is far above what occurs";
}

// Both renderers draw the same edge: where they disagree on what is outside, a coordinate is near
// it.
TEST(GoldenRenderer, OutsideIsOutsideInTheRealFrame) {
  uint64_t inside = 0;
  uint64_t outside = 0;
  uint64_t different = 0;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    test::Random random(seed + 1000);
    const Camera camera = test::random_camera(random, stream.decoder->header());
    const auto record = frame_record(camera, stream.decoder->header());
    ASSERT_TRUE(record.has_value()) << record.error().message;
    const auto real = render_real(*stream.decoder, camera, 0);
    for (int32_t j = 0; j < record->frame_height; ++j) {
      for (int32_t i = 0; i < record->frame_width; ++i) {
        const bool fixed = trace(*record, i, j).has_value();
        const auto at = static_cast<size_t>(j) * real->width + static_cast<size_t>(i);
        ++(fixed ? inside : outside);
        if (fixed != (real->inside[at] != 0)) ++different;
      }
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_GT(outside, 1000u);
  EXPECT_LT(different, (inside + outside) / 500);
}

}  // namespace
}  // namespace hmlfc
