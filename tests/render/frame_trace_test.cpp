// The trace of a pixel against the frames of the golden renderer.
#include <gtest/gtest.h>

#include <algorithm>

#include <hmlfc/frame_trace.hpp>
#include <hmlfc/renderer.hpp>

#include "render/render_cases.hpp"

namespace hmlfc {
namespace {

int64_t value_of(const FrameStage& stage, std::string_view name) {
  const auto found = std::ranges::find(stage.values, name, &FrameValue::name);
  EXPECT_NE(found, stage.values.end()) << name;
  return found->value;
}

TEST(FrameTrace, EveryPixelIsThatOfTheFrame) {
  uint64_t outside = 0;
  uint64_t displaced = 0;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    test::Random random(seed);
    const Camera camera = test::random_camera_with_geometry(random, stream.decoder->header());
    const FrameRecord record = *frame_record(camera, stream.decoder->header());
    const int stop_level = static_cast<int>(
        random() % static_cast<uint32_t>(stream.decoder->header().tree_height + 1));
    Frame frame;
    ASSERT_TRUE(make_golden_renderer(*stream.decoder)->render(record, stop_level, frame));
    for (uint32_t y = 0; y < frame.image.height; y += 3) {
      for (uint32_t x = 0; x < frame.image.width; x += 5) {
        const auto traced = frame_trace(*stream.decoder, record, stop_level, x, y);
        ASSERT_TRUE(traced);
        const uint16_t* sample = &frame.image.samples[3 * (size_t{y} * frame.image.width + x)];
        ASSERT_TRUE(std::equal(traced->sample.begin(), traced->sample.end(), sample)) << seed;
        const FrameStage& last = traced->stages.back();
        if (last.name != "sum") {
          ASSERT_EQ(value_of(last, "outside"), 1);
          ++outside;
          continue;
        }
        int64_t weights = 0;
        for (const FrameStage& stage : traced->stages) {
          if (stage.name == "view") weights += value_of(stage, "weight");
          if (stage.name == "cell" && value_of(stage, "E") != 0) ++displaced;
        }
        ASSERT_EQ(weights, 65536);
      }
    }
  }
  EXPECT_GT(outside, 100u);
  EXPECT_GT(displaced, 100u);
}

TEST(FrameTrace, NamesTheRecordAndRefusesPixelsOutsideTheFrame) {
  const test::OpenedStream stream(test::random_stream(1));
  const FrameRecord record = *frame_record({}, stream.decoder->header());
  const auto names = frame_record_names();
  const auto field = [&](std::string_view name) {
    const auto at = std::ranges::find(names, name) - names.begin();
    return frame_record_values(record).at(static_cast<size_t>(at));
  };
  EXPECT_EQ(field("n0_hi.z"), 1 << 28);
  EXPECT_EQ(field("width"), record.width);
  EXPECT_EQ(field("fine"), record.fine);
  const auto beside = static_cast<uint32_t>(record.frame_width);
  EXPECT_EQ(frame_trace(*stream.decoder, record, 0, beside, 0).error().code,
            ErrorCode::kBadRequest);
}

}  // namespace
}  // namespace hmlfc
