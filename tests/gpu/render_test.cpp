// Frames of the GPU renderer against those of the golden renderer: every byte, the blocks needed
// and the errors, on random streams and cameras.
#include <array>

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

TEST_F(GpuRendering, KeepsItsBoundsInSmallChunks) {
  for (const uint64_t chunk_bytes : {0u, 1024u}) {
    DeviceOptions options;
    options.guard_pages = true;
    options.chunk_bytes = chunk_bytes;
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
}

TEST_F(GpuRendering, UsesVulkanAsTheValidationLayerWants) {
  DeviceOptions options;
  options.validation = true;
  auto device = Device::open(options);
  if (!device && device.error().message.find("validation layer") != std::string::npos) {
    GTEST_SKIP() << device.error().message;
  }
  ASSERT_TRUE(device) << device.error().message;
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

}  // namespace
}  // namespace hmlfc::gpu
