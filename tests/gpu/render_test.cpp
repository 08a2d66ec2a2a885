// Frames of the GPU renderer against those of the golden renderer: every byte, the blocks needed
// and the errors, on random streams and cameras, and on scenes in depth.
#include <array>

#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "gpu/render_pair.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuRendering : public GpuTest {};

/// Bytes of the cache of case `seed`: none, a few pages, all that a small stream has.
uint64_t budget(uint32_t seed) { return std::array<uint64_t, 3>{0, 8192, 1u << 24}[seed % 3]; }

/// Random cameras before the stream `bytes`.
void compare_frames(Device& device, std::vector<uint8_t> bytes, uint32_t seed, int frames,
                    FrameTally& tally) {
  RenderPair pair(device, std::move(bytes), budget(seed));
  if (pair.closed()) return;
  test::Random random(seed);
  for (int i = 0; i < frames; ++i) {
    Camera camera = test::random_camera(random, pair.header());
    camera.geometry = static_cast<GeometrySource>(i % 2);
    const auto record = frame_record(camera, pair.header());
    const int stop =
        random() % 3 == 0
            ? static_cast<int>(random() % (1u + static_cast<uint32_t>(pair.header().tree_height)))
            : 0;
    if (record) pair.compare(*record, stop, tally);
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " frame " << i;
  }
}

TEST_F(GpuRendering, EqualsTheGoldenRenderer) {
  FrameTally tally;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    compare_frames(device(), test::random_stream(seed), seed, 8, tally);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(tally.frames, 300u);
  EXPECT_GT(tally.lit, 150u);
  EXPECT_GT(tally.displaced, 15u);
}

TEST_F(GpuRendering, NamesTheErrorOfTheFirstNeededBlock) {
  FrameTally tally;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    auto bytes = test::random_stream(seed);
    tb::corrupt(bytes, seed % 4 == 0 ? tb::Damage::kKeyImages : tb::Damage::kIndexAndTiles, seed);
    compare_frames(device(), std::move(bytes), seed, 6, tally);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(tally.failed, 50u);
  EXPECT_GT(tally.lit, 20u);
}

// The stream, the reference area and the pool each lie in many buffers.
TEST_F(GpuRendering, EqualsTheGoldenRendererInSmallChunks) {
  DeviceOptions options;
  options.chunk_bytes = 1024;
  auto device = open(options);
  ASSERT_TRUE(device);
  FrameTally tally;
  for (uint32_t seed = 100; seed < 112; ++seed) {
    auto bytes = test::random_stream(seed);
    if (seed % 2 == 0) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    compare_frames(*device, std::move(bytes), seed, 4, tally);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(tally.frames, 30u);
}

TEST_F(GpuRendering, UsesVulkanAsTheValidationLayerWants) {
  auto device = open_validated();
  ASSERT_TRUE(device);
  FrameTally tally;
  for (uint32_t seed = 0; seed < 4; ++seed) {
    compare_frames(*device, test::random_stream(seed), seed, 3, tally);
  }
  for (const std::string& message : device->validation_messages()) ADD_FAILURE() << message;
}

TEST_F(GpuRendering, RefusesAFrameOfAnotherLightField) {
  RenderPair pair(device(), test::random_stream(3), 0);
  ASSERT_FALSE(pair.closed());
  auto record = frame_record({}, pair.header());
  ASSERT_TRUE(record);
  FrameTally tally;
  pair.compare(*record, pair.header().tree_height + 1, tally);
  ++record->cols;
  pair.compare(*record, 0, tally);
  EXPECT_EQ(tally.failed, 2u);
}

constexpr uint64_t kCacheOfAll = uint64_t{1} << 24;

class GpuGeometry : public GpuTest {};

TEST_F(GpuGeometry, EqualsTheGoldenRenderer) {
  FrameTally tally;
  for (const uint64_t cache_bytes : {uint64_t{0}, uint64_t{16384}, kCacheOfAll}) {
    EXPECT_EQ(difference_of_scenes(device(), 4, tb::Damage::kNone, cache_bytes, tally), "");
  }
  EXPECT_EQ(tally.failed, 0u);
  EXPECT_GT(tally.displaced, 100u);
}

TEST_F(GpuGeometry, TakesBlocksWithAnErrorAsOnesThatTellNothing) {
  FrameTally tally;
  EXPECT_EQ(difference_of_scenes(device(), 24, tb::Damage::kIndexAndTiles, kCacheOfAll, tally), "");
  EXPECT_GT(tally.failed, 20u);
  EXPECT_GT(tally.displaced, 20u);
}

}  // namespace
}  // namespace hmlfc::gpu
