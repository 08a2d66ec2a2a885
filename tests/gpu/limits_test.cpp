// Streams and requests cut into parts: the result does not depend on the cuts.
#include "decoder/open_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuLimits : public GpuTest {};

// Chunks so small that a record, and a row of the reference area, lies in several. Half of the
// streams are damaged.
TEST_F(GpuLimits, StreamsLargerThanABufferAreEqual) {
  for (const uint64_t chunk_bytes : {64u, 1024u}) {
    DeviceOptions options;
    options.chunk_bytes = chunk_bytes;
    auto device = open(options);
    ASSERT_TRUE(device);
    for (uint32_t seed = 0; seed < 12; ++seed) {
      auto bytes = tb::suite_stream(seed % 6, 2u << seed % 3);
      ASSERT_GT(bytes.size(), chunk_bytes);
      if (seed >= 6) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
      const CheckCounts counts = expect_equal(*device, bytes, {.requests = 200, .seed = seed});
      EXPECT_TRUE(seed >= 6 || counts.compared > 200);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << " chunks of " << chunk_bytes;
    }
  }
}

TEST_F(GpuLimits, SubmissionsOfAFewBlocksAreEqual) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    const auto bytes = tb::suite_stream(seed, 4);
    const CheckCounts counts = expect_equal(
        device(), bytes, {.requests = 60, .seed = seed, .borders = false, .blocks_at_once = 7});
    EXPECT_EQ(counts.compared, 60u);
  }
}

// Whole planes in one area: cut by rows and inside rows.
TEST_F(GpuLimits, AreasAreCutAnywhere) {
  const auto bytes = tb::suite_stream(6, 4);
  const auto view = open_stream(bytes, {});
  ASSERT_TRUE(view);
  auto decoder = GpuDecoder::open(device(), *view);
  ASSERT_TRUE(decoder) << decoder.error().message;
  const PlaneShape& shape = view->geometry.plane(Plane::kY);
  ASSERT_GT(shape.blocks_x, 3u);
  const BlockArea area{{0, 0}, Plane::kY, 0, 0, shape.blocks_x, shape.blocks_y, 0};
  const auto whole = decoder->decode(std::span(&area, 1));
  const PixelArea pixels{{0, 0}, 1, 0, shape.blocks_x - 1, shape.blocks_y, 0};
  const auto whole_pixels = decoder->decode_rgb(std::span(&pixels, 1));
  ASSERT_TRUE(whole && whole_pixels);
  ASSERT_EQ(whole->statuses.size(), size_t{shape.blocks_x} * shape.blocks_y);
  for (const uint64_t limit : {uint64_t{3}, uint64_t{shape.blocks_x} - 1, uint64_t{shape.blocks_x},
                               3 * uint64_t{shape.blocks_x} + 2}) {
    decoder->limit_submissions(limit);
    const auto cut = decoder->decode(std::span(&area, 1));
    const auto cut_pixels = decoder->decode_rgb(std::span(&pixels, 1));
    ASSERT_TRUE(cut && cut_pixels);
    EXPECT_EQ(cut->samples, whole->samples) << limit;
    EXPECT_EQ(cut->statuses, whole->statuses) << limit;
    EXPECT_EQ(cut_pixels->samples, whole_pixels->samples) << limit;
  }
}

TEST_F(GpuLimits, NoAreasGiveNoBlocks) {
  const auto bytes = tb::suite_stream(2, 4);
  const auto view = open_stream(bytes, {});
  auto decoder = GpuDecoder::open(device(), *view);
  ASSERT_TRUE(decoder);
  const auto none = decoder->decode({});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->statuses.empty());
}

}  // namespace
}  // namespace hmlfc::gpu
