// Frames do not touch views, pixels and bytes that they do not need (NED-1).
#include <gtest/gtest.h>

#include <algorithm>

#include <hmlfc/renderer.hpp>

#include "render/render_cases.hpp"

namespace hmlfc {
namespace {

// Counts what is read of the TOP section and of those after it.
class Touched final : public ReadSink {
 public:
  Touched(uint64_t file_bytes, uint64_t top_end)
      : top_(file_bytes), rest_(file_bytes), top_end_(top_end) {}
  void on_read(uint64_t offset, uint64_t bytes) override {
    (offset < top_end_ ? top_ : rest_).on_read(offset, bytes);
  }
  void on_key_plane(uint64_t samples) override { top_.on_key_plane(samples); }
  const TouchedBytes& top() const { return top_; }
  const TouchedBytes& rest() const { return rest_; }
  void reset() {
    top_.reset();
    rest_.reset();
  }

 private:
  TouchedBytes top_;
  TouchedBytes rest_;
  uint64_t top_end_;
};

struct Cost {
  uint64_t file = 0;
  uint64_t top = 0;   // bytes of the TOP section
  uint64_t rest = 0;  // of the other sections
  uint64_t key_samples = 0;
  uint64_t view_samples = 0;  // of one plane of Y
  FrameCounts counts;
};

uint64_t top_end(const std::vector<uint8_t>& file) {
  return Decoder::open(file)->header().sections[1].offset;
}

// A frame of 32 x 24 pixels of the middle of the views, between four views in the middle.
FrameRecord middle_record(const StreamHeader& header) {
  Camera camera;
  camera.frame_width = 32;
  camera.frame_height = 24;
  camera.focal = 64;
  camera.tan_half = 0.25;
  camera.position = WorldPoint{header.cols / 2 - 0.5, header.rows / 2 - 0.5, 0};
  return *frame_record(camera, header);
}

// The cost of that frame with a cold cache.
Cost cost_of(const LightFieldShape& shape, EncodeParams params) {
  const LightField field = test::textured_light_field(shape, 4, 40);
  const std::vector<uint8_t> file = encode(field, params)->bytes;
  Touched touched(file.size(), top_end(file));
  OpenOptions options;
  options.check_sections = false;
  options.reads = &touched;
  const auto decoder = Decoder::open(file, options);
  Frame frame;
  EXPECT_TRUE(
      make_cpu_renderer(*decoder)->render(middle_record(decoder->header()), 0, frame).has_value());
  return {file.size(),
          touched.top().bytes(),
          touched.rest().bytes(),
          touched.top().key_samples(),
          uint64_t{shape.width} * shape.height,
          frame.counts};
}

// All except key images, which are read whole (KEY-3).
void expect_flat(const Cost& small, const Cost& large) {
  EXPECT_GT(large.file, 3 * small.file);
  EXPECT_GT(small.rest, 0u);
  EXPECT_LT(large.rest, small.rest * 3 / 2) << small.rest;
  EXPECT_GT(small.key_samples, 0u);
  EXPECT_LE(large.counts.blocks_needed, small.counts.blocks_needed * 5 / 4);
  EXPECT_EQ(large.counts.blocks_decoded, large.counts.blocks_needed);
  EXPECT_EQ(large.counts.samples_interpolated, small.counts.samples_interpolated);
}

std::vector<EncodeParams> profiles() {
  EncodeParams main;
  main.profile = Profile::kMain;
  main.chroma = ChromaFormat::k420;
  main.tree_height = 2;
  main.window = 4;
  main.ref_rows = main.ref_cols = 3;
  main.main.threshold_ref = main.main.threshold_pred = 2;
  EncodeParams extended = main;
  extended.profile = Profile::kExtended;
  extended.tree_height = 0;
  extended.window = 16;
  extended.extended.quality = 80;
  extended.extended.preset = Preset::kFast;
  return {main, extended};
}

// The four views lie in one cluster of either grid, the pixels in the middle of four tiles.
TEST(Skipping, BytesStayFlatAsTheGridGrows) {
  for (const EncodeParams& params : profiles()) {
    const Cost small = cost_of({6, 6, 64, 48, 8}, params);
    const Cost large = cost_of({14, 14, 64, 48, 8}, params);
    expect_flat(small, large);
    EXPECT_LE(large.key_samples, small.key_samples);
    EXPECT_LT(large.top, small.top * 3 / 2) << small.top;
  }
}

// The frame needs the same planes of key images, but each grows with the picture.
TEST(Skipping, BytesStayFlatAsPicturesGrowButForKeyImages) {
  for (const EncodeParams& params : profiles()) {
    const Cost small = cost_of({6, 6, 128, 128, 8}, params);
    const Cost large = cost_of({6, 6, 256, 256, 8}, params);
    expect_flat(small, large);
    EXPECT_EQ(large.key_samples / large.view_samples, small.key_samples / small.view_samples);
    EXPECT_GT(large.top, 2 * small.top);
  }
}

// Planes of key images are found before they are decoded, all at once: those that blocks need, each
// once, and no others.
TEST(Skipping, KeyPlanesAreThoseOfTheGoldenRenderer) {
  uint64_t all = 0;
  uint64_t most = 0;
  for (uint32_t seed = 400; seed < 440; ++seed) {
    const std::vector<uint8_t> file = test::random_stream(seed);
    test::Random random(seed);
    TouchedBytes touched(file.size());
    OpenOptions options;
    options.reads = &touched;
    for (int n = 0; n < 3; ++n) {
      const StreamHeader header = Decoder::open(file)->header();
      const auto record = frame_record(test::random_camera(random, header), header);
      ASSERT_TRUE(record.has_value()) << record.error().message;
      const auto key_samples_of = [&](const auto& make) {
        const auto decoder = Decoder::open(file, options);
        touched.reset();
        Frame frame;
        EXPECT_TRUE(make(*decoder)->render(*record, 0, frame).has_value());
        return touched.key_samples();
      };
      const uint64_t golden = key_samples_of(make_golden_renderer);
      const uint64_t fast =
          key_samples_of([](const Decoder& decoder) { return make_cpu_renderer(decoder); });
      EXPECT_EQ(fast, golden) << "seed " << seed << ", frame " << n;
      all += golden;
      most = std::max(most, golden / (uint64_t{header.width} * header.height));
    }
  }
  EXPECT_GT(all, 0u);
  EXPECT_GT(most, 4u) << "planes of several key images";
}

// Each pass of a progressive frame reads its own level; key images and coarser levels are held.
TEST(Skipping, FinerFramesReadTheirOwnLevelAlone) {
  const EncodeParams params = profiles()[0];
  const LightField field = test::textured_light_field({8, 8, 96, 64, 8}, 4, 40);
  const std::vector<uint8_t> file = encode(field, params)->bytes;
  Touched touched(file.size(), top_end(file));
  OpenOptions options;
  options.check_sections = false;
  options.reads = &touched;
  // The bytes that frames of these levels touch after TOP, one after another.
  const auto bytes_of = [&](std::vector<int> levels, bool progressive) {
    const auto decoder = Decoder::open(file, options);
    RenderOptions render;
    render.progressive = progressive;
    const auto renderer = make_cpu_renderer(*decoder, render);
    std::vector<uint64_t> bytes;
    for (const int level : levels) {
      touched.reset();
      Frame frame;
      EXPECT_TRUE(renderer->render(middle_record(decoder->header()), level, frame).has_value());
      EXPECT_EQ(touched.top().key_samples() > 0, bytes.empty()) << level;
      bytes.push_back(touched.rest().bytes());
    }
    return bytes;
  };
  const auto cold = bytes_of({0}, true);
  const auto apart = bytes_of({2, 1, 0}, false);
  const auto refined = bytes_of({2, 1, 0}, true);
  ASSERT_EQ(params.tree_height, 2);
  EXPECT_EQ(refined[0], apart[0]);
  EXPECT_EQ(refined[0], 0u) << "key images alone";
  EXPECT_EQ(refined[1], apart[1]);
  EXPECT_LT(refined[2], apart[2]);
  EXPECT_GE(refined[1] + refined[2], cold[0]);
  // Lines that hold parts of both levels are counted in both.
  EXPECT_LT(refined[1] + refined[2], cold[0] * 5 / 4) << cold[0];
}

// The cache keeps blocks between frames up to its budget: a second orbit decodes nothing; without a
// budget, everything.
TEST(Skipping, TheBudgetIsKept) {
  const LightField field = test::textured_light_field({5, 5, 90, 140, 8}, 4, 10);
  const test::OpenedStream stream(encode(field, profiles()[0])->bytes);
  const auto decoded_again = [&](size_t cache_bytes) {
    RenderOptions options;
    options.cache_bytes = cache_bytes;
    const auto renderer = make_cpu_renderer(*stream.decoder, options);
    uint64_t decoded = 0;
    for (int turn = 0; turn < 2; ++turn) {
      decoded = 0;
      for (int k = 0; k < 8; ++k) {
        Camera camera;
        camera.position = WorldPoint{k / 2.0, 4 - k / 2.0, 0};
        Frame frame;
        EXPECT_TRUE(renderer->render(*frame_record(camera, stream.decoder->header()), 0, frame)
                        .has_value());
        decoded += frame.counts.blocks_decoded;
      }
    }
    return decoded;
  };
  const uint64_t all = decoded_again(0);
  const uint64_t some = decoded_again(400000);
  EXPECT_EQ(decoded_again(size_t{1} << 30), 0u);
  EXPECT_GT(some, 0u);
  EXPECT_LT(some, all);
}

}  // namespace
}  // namespace hmlfc
