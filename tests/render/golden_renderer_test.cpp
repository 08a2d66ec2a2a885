// The golden renderer against the real frame, and where it must be exact.
#include <gtest/gtest.h>

#include <hmlfc/renderer.hpp>

#include "render/ray.hpp"
#include "render/render_cases.hpp"

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
