// What frames leave alone: views, pixels and bytes that they do not need (NED-1).
#include <gtest/gtest.h>

#include <hmlfc/renderer.hpp>

#include "render/render_cases.hpp"
#include "samples/touched_bytes.hpp"

namespace hmlfc {
namespace {

// Counts the bytes read behind `begin` alone: key images, which OpenJPEG reads whole, lie before.
class TouchedBehind final : public ReadSink {
 public:
  TouchedBehind(uint64_t file_bytes, uint64_t begin) : touched_(file_bytes), begin_(begin) {}
  void on_read(uint64_t offset, uint64_t bytes) override {
    if (offset >= begin_) touched_.on_read(offset, bytes);
  }
  uint64_t bytes() const { return touched_.bytes(); }

 private:
  TouchedBytes touched_;
  uint64_t begin_;
};

struct Cost {
  uint64_t file = 0;
  uint64_t touched = 0;
  FrameCounts counts;
};

// A cold frame of 32 x 24 pixels of the middle of the views, between four views in the middle.
Cost cost_of(const LightFieldShape& shape, EncodeParams params) {
  const LightField field = test::textured_light_field(shape, 4, 40);
  const std::vector<uint8_t> file = encode(field, params)->bytes;
  const uint64_t begin = Decoder::open(file)->header().sections[1].offset;
  TouchedBehind touched(file.size(), begin);
  OpenOptions options;
  options.check_sections = false;
  options.reads = &touched;
  const auto decoder = Decoder::open(file, options);
  Camera camera;
  camera.frame_width = 32;
  camera.frame_height = 24;
  camera.focal = 64;
  camera.tan_half = 0.25;
  camera.position = WorldPoint{shape.cols / 2 - 0.5, shape.rows / 2 - 0.5, 0};
  Frame frame;
  EXPECT_TRUE(make_cpu_renderer(*decoder)
                  ->render(*frame_record(camera, decoder->header()), 0, frame)
                  .has_value());
  return {file.size(), touched.bytes(), frame.counts};
}

void expect_flat(const Cost& small, const Cost& large) {
  EXPECT_GT(large.file, 3 * small.file);
  EXPECT_GT(small.touched, 0u);
  EXPECT_LT(large.touched, small.touched * 3 / 2) << small.touched;
  EXPECT_LE(large.counts.blocks_needed, small.counts.blocks_needed * 5 / 4);
  EXPECT_EQ(large.counts.blocks_decoded, large.counts.blocks_needed);
  EXPECT_EQ(large.counts.samples_interpolated, small.counts.samples_interpolated);
}

std::vector<EncodeParams> profiles() {
  EncodeParams main;
  main.tree_height = 2;
  main.window = 4;
  main.ref_rows = main.ref_cols = 3;
  main.threshold_ref = main.threshold_pred = 2;
  EncodeParams extended = main;
  extended.profile = Profile::kExtended;
  extended.tree_height = 0;
  extended.window = 16;
  extended.quality = 80;
  extended.preset = Preset::kFast;
  return {main, extended};
}

// The four views lie in one cluster of either grid, the pixels in the middle of four tiles.
TEST(Skipping, BytesStayFlatAsTheGridGrows) {
  for (const EncodeParams& params : profiles()) {
    expect_flat(cost_of({6, 6, 64, 48, 8}, params), cost_of({14, 14, 64, 48, 8}, params));
  }
}

TEST(Skipping, BytesStayFlatAsPicturesGrow) {
  for (const EncodeParams& params : profiles()) {
    expect_flat(cost_of({6, 6, 128, 128, 8}, params), cost_of({6, 6, 256, 256, 8}, params));
  }
}

// A frame at a view's place needs that view alone: all its blocks, each once.
TEST(Skipping, OneViewNeedsItsBlocksAlone) {
  for (const EncodeParams& params : profiles()) {
    const LightField field = test::textured_light_field({4, 4, 70, 50, 8}, 4, 40);
    const test::OpenedStream stream(encode(field, params)->bytes);
    const StreamHeader& header = stream.decoder->header();
    Camera camera;
    camera.position = WorldPoint{2, 1, 0};
    Frame frame;
    ASSERT_TRUE(make_cpu_renderer(*stream.decoder)
                    ->render(*frame_record(camera, header), 0, frame)
                    .has_value());
    uint64_t blocks = 0;
    for (const Plane plane : kPlanes) {
      const PlaneSize size = stream.decoder->plane_size(plane);
      const uint64_t side = header.block_size();
      blocks += ((size.width + side - 1) / side) * ((size.height + side - 1) / side);
    }
    EXPECT_EQ(frame.counts.blocks_decoded, blocks);
    EXPECT_EQ(frame.counts.samples_interpolated, uint64_t{70} * 50 * 3);
  }
}

// Between frames blocks are kept up to the budget: an orbit again decodes nothing; with no budget
// all of it.
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
