// The fast renderer against the golden one: frames, counts and errors, on every instruction set.
#include <gtest/gtest.h>

#include <array>

#include <hmlfc/renderer.hpp>

#include "render/render_cases.hpp"
#include "render/row_kernels.hpp"
#include "support/instruction_sets.hpp"

namespace hmlfc {
namespace {

// The golden renderer's frame, or its error.
struct Golden {
  Golden(const Decoder& decoder, const FrameRecord& record, int level)
      : done(make_golden_renderer(decoder)->render(record, level, frame)) {}

  Frame frame;
  Result<void> done;
};

// The fast renderer gives the same samples, or the same error.
void expect_same(const Golden& golden, FrameRenderer& fast, const FrameRecord& record, int level,
                 const std::string& what) {
  Frame frame;
  const auto done = fast.render(record, level, frame);
  ASSERT_EQ(done.has_value(), golden.done.has_value()) << what;
  if (!done) {
    EXPECT_EQ(to_string(done.error()), to_string(golden.done.error())) << what;
    return;
  }
  const Frame& expected = golden.frame;
  EXPECT_EQ(frame.image.width, expected.image.width);
  EXPECT_EQ(frame.image.height, expected.image.height);
  EXPECT_EQ(frame.image.depth, expected.image.depth);
  ASSERT_EQ(frame.image.samples, expected.image.samples) << what;
  EXPECT_EQ(frame.counts.samples_interpolated, expected.counts.samples_interpolated) << what;
  EXPECT_EQ(frame.counts.blocks_needed, expected.counts.blocks_needed) << what;
  EXPECT_EQ(frame.counts.disparities_looked_up, expected.counts.disparities_looked_up) << what;
  EXPECT_EQ(frame.counts.blocks_decoded + frame.counts.blocks_reused, frame.counts.blocks_needed);
}

int random_level(test::Random& random, const Decoder& decoder) {
  return static_cast<int>(random() % static_cast<uint32_t>(decoder.header().tree_height + 1));
}

// A cold cache: every block that is needed is decoded, and no other (NED-1).
TEST(CpuRenderer, ColdFramesEqualTheGoldenRenderer) {
  uint64_t samples = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    const Decoder& decoder = *stream.decoder;
    test::Random random(seed);
    for (int n = 0; n < 4; ++n) {
      const auto record = frame_record(test::random_camera_with_geometry(random, decoder.header()),
                                       decoder.header());
      ASSERT_TRUE(record.has_value()) << record.error().message;
      const int level = random_level(random, decoder);
      const Golden golden(decoder, *record, level);
      for (const int64_t target : test::instruction_sets()) {
        const test::ChosenInstructionSet chosen(target);
        const std::string what =
            "seed " + std::to_string(seed) + ", " + test::instruction_set_name(target);
        const auto fast = make_cpu_renderer(decoder);
        expect_same(golden, *fast, *record, level, what);
        Frame again;
        ASSERT_TRUE(fast->render(*record, level, again).has_value());
        EXPECT_EQ(again.counts.blocks_decoded, 0u) << what;
        EXPECT_EQ(again.counts.blocks_reused, golden.frame.counts.blocks_needed) << what;
        samples += again.counts.samples_interpolated;
      }
    }
  }
  EXPECT_GT(samples, 100000u);
}

// A warm cache, with budgets from nothing to all: its contents never change a frame.
TEST(CpuRenderer, SequencesOfFramesEqualTheGoldenRenderer) {
  for (uint32_t seed = 100; seed < 130; ++seed) {
    const test::OpenedStream stream(test::random_stream(seed));
    const Decoder& decoder = *stream.decoder;
    test::Random random(seed);
    RenderOptions options;
    options.cache_bytes = std::array<size_t, 4>{0, 20000, 100000, size_t{1} << 30}[seed % 4];
    const auto fast = make_cpu_renderer(decoder, options);
    for (int n = 0; n < 12; ++n) {
      const auto record = frame_record(test::random_camera_with_geometry(random, decoder.header()),
                                       decoder.header());
      const int level = random_level(random, decoder);
      expect_same(Golden(decoder, *record, level), *fast, *record, level,
                  "seed " + std::to_string(seed) + ", frame " + std::to_string(n));
    }
  }
}

// Frames from coarse to fine, each decoded from the one before, on intact and damaged streams;
// sometimes with another camera in between, so that parts of the coarser level are missing.
TEST(CpuRenderer, ProgressiveFramesEqualTheGoldenRenderer) {
  int failed = 0;
  for (uint32_t seed = 300; seed < 380; ++seed) {
    test::Random random(seed);
    std::vector<uint8_t> bytes = test::random_stream(seed);
    if (seed % 4 == 3) test::damage(random, bytes);
    OpenOptions unchecked;
    unchecked.check_sections = false;
    const test::OpenedStream stream(std::move(bytes), unchecked);
    if (!stream.decoder) continue;
    const Decoder& decoder = *stream.decoder;
    RenderOptions options;
    options.progressive = true;
    options.cache_bytes = std::array<size_t, 3>{size_t{1} << 30, 60000, 0}[seed % 3];
    const auto fast = make_cpu_renderer(decoder, options);
    for (int n = 0; n < 4; ++n) {
      Camera camera = test::random_camera_with_geometry(random, decoder.header());
      for (int level = decoder.header().tree_height; level >= 0; --level) {
        if (n % 2 == 1) camera = test::random_camera_with_geometry(random, decoder.header());
        const auto record = frame_record(camera, decoder.header());
        const Golden golden(decoder, *record, level);
        expect_same(golden, *fast, *record, level,
                    "seed " + std::to_string(seed) + ", level " + std::to_string(level));
        if (!golden.done) ++failed;
      }
    }
  }
  EXPECT_GT(failed, 20);
}

// Large frames and views: rows of several vectors, pages and threads.
TEST(CpuRenderer, LargeFramesEqualTheGoldenRenderer) {
  EncodeParams params;
  params.tree_height = 3;
  params.ref_rows = params.ref_cols = 8;
  params.extended.preset = Preset::kFast;
  params.extended.quality = 50;
  const LightField field = test::textured_light_field({3, 3, 210, 150, 8}, 3, 20);
  const test::OpenedStream stream(encode(field, params)->bytes);
  const Decoder& decoder = *stream.decoder;
  test::Random random(9);
  for (int n = 0; n < 3; ++n) {
    Camera camera = test::random_camera_with_geometry(random, decoder.header());
    camera.filter = Filter::kQuadrilinear;
    camera.frame_width = 301;
    camera.frame_height = 203;
    camera.tan_half.reset();
    camera.focal.reset();
    const auto record = frame_record(camera, decoder.header());
    const Golden golden(decoder, *record, 0);
    for (const int64_t target : test::instruction_sets()) {
      const test::ChosenInstructionSet chosen(target);
      for (int threads = 1; threads <= 2; ++threads) {
        RenderOptions options;
        options.threads = threads;
        expect_same(golden, *make_cpu_renderer(decoder, options), *record, 0,
                    test::instruction_set_name(target));
      }
    }
  }
}

// NED-2: damage in blocks that a frame does not need has no effect; else both report the error of
// the same block.
TEST(CpuRendererErrors, DamagedStreamsEqualTheGoldenRenderer) {
  int failed = 0;
  int drawn = 0;
  for (uint32_t seed = 0; seed < 120; ++seed) {
    test::Random random(seed);
    std::vector<uint8_t> bytes = test::random_stream(seed % 40);
    test::damage(random, bytes);
    OpenOptions options;
    options.check_sections = false;
    const test::OpenedStream stream(bytes, options);
    if (!stream.decoder) continue;
    const Decoder& decoder = *stream.decoder;
    const auto fast = make_cpu_renderer(decoder);
    for (int n = 0; n < 3; ++n) {
      const auto record = frame_record(test::random_camera_with_geometry(random, decoder.header()),
                                       decoder.header());
      const Golden golden(decoder, *record, 0);
      expect_same(golden, *fast, *record, 0, "seed " + std::to_string(seed));
      ++(golden.done.has_value() ? drawn : failed);
    }
  }
  EXPECT_GT(failed, 50);
  EXPECT_GT(drawn, 50);
}

TEST(CpuRendererErrors, RequestsThatDoNotFitAreRefused) {
  const test::OpenedStream stream(test::random_stream(2));
  const Decoder& decoder = *stream.decoder;
  const FrameRecord good = *frame_record(Camera{}, decoder.header());
  const auto refused = [&](const FrameRecord& record, int level) {
    for (const auto& renderer : {make_cpu_renderer(decoder), make_golden_renderer(decoder)}) {
      Frame frame;
      const auto done = renderer->render(record, level, frame);
      EXPECT_TRUE(!done && done.error().code == ErrorCode::kBadRequest);
    }
  };
  refused(good, -1);
  refused(good, decoder.header().tree_height + 1);
  FrameRecord record = good;
  ++record.cols;
  refused(record, 0);
  record = good;
  record.frame_width = 0;
  refused(record, 0);
  record = good;
  record.aperture = 4;
  refused(record, 0);
}

}  // namespace
}  // namespace hmlfc
