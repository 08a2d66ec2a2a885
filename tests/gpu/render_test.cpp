// Frames of the GPU renderer against those of the golden renderer: every byte, the blocks needed
// and the errors, on random streams and cameras.
#include <algorithm>

#include <hmlfc/renderer.hpp>

#include "gpu/gpu_test.hpp"
#include "gpu_renderer.hpp"
#include "random_stream.hpp"
#include "render/render_cases.hpp"
#include "samples/open_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuRendering : public GpuTest {};

/// What was compared.
struct FrameTally {
  uint64_t frames = 0;
  uint64_t failed = 0;    ///< with an error, equal in both
  uint64_t lit = 0;       ///< with a sample above 0
  uint64_t repeated = 0;  ///< that took two submissions
};

/// One stream, opened for both renderers.
class RenderPair {
 public:
  RenderPair(Device& device, std::vector<uint8_t> bytes)
      : stream_(std::move(bytes), unchecked()), view_(open_stream(stream_.bytes, unchecked())) {
    if (!stream_.decoder || !view_) return;
    golden_ = make_golden_renderer(*stream_.decoder);
    auto opened = GpuRenderer::open(device, *view_);
    if (!opened) {
      ADD_FAILURE() << opened.error().message;
      return;
    }
    gpu_.emplace(std::move(*opened));
  }

  /// Nothing to compare: the stream does not open.
  bool closed() const { return !gpu_; }

  const StreamHeader& header() const { return view_->header; }

  void compare(const FrameRecord& record, int stop_level, FrameTally& tally) {
    Frame expected;
    const auto golden = golden_->render(record, stop_level, expected);
    const auto actual = gpu_->render(record, stop_level);
    ASSERT_TRUE(actual) << actual.error().message;
    ++tally.frames;
    if (actual->submissions > 1) ++tally.repeated;
    const ErrorCode status = golden ? ErrorCode::kOk : golden.error().code;
    ASSERT_EQ(error_name(actual->status), error_name(status));
    if (!golden) {
      ++tally.failed;
      return;
    }
    EXPECT_EQ(actual->image.width, expected.image.width);
    EXPECT_EQ(actual->image.height, expected.image.height);
    EXPECT_EQ(actual->image.depth, expected.image.depth);
    EXPECT_EQ(actual->blocks_needed, expected.counts.blocks_needed);
    ASSERT_EQ(actual->image.samples, expected.image.samples);
    const auto& samples = expected.image.samples;
    if (std::ranges::any_of(samples, [](uint16_t sample) { return sample != 0; })) ++tally.lit;
  }

 private:
  static OpenOptions unchecked() {
    OpenOptions options;
    options.check_sections = false;
    return options;
  }

  test::OpenedStream stream_;
  Result<StreamView> view_;
  std::unique_ptr<FrameRenderer> golden_;
  std::optional<GpuRenderer> gpu_;
};

/// Random cameras before the stream `bytes`.
void compare_frames(Device& device, std::vector<uint8_t> bytes, uint32_t seed, int frames,
                    FrameTally& tally) {
  RenderPair pair(device, std::move(bytes));
  if (pair.closed()) return;
  test::Random random(seed);
  for (int i = 0; i < frames; ++i) {
    const Camera camera = test::random_camera(random, pair.header());
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
}

TEST_F(GpuRendering, NamesTheErrorOfTheFirstNeededBlock) {
  FrameTally tally;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    auto bytes = test::random_stream(seed);
    tb::spoil(bytes, seed % 4 == 0 ? tb::Damage::kKeyImages : tb::Damage::kIndexAndTiles, seed);
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
      if (seed % 2 == 0) tb::spoil(bytes, tb::Damage::kIndexAndTiles, seed);
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

// More blocks than a renderer makes room for at first: 2 x 2 samples each.
TEST_F(GpuRendering, MakesRoomForALargeFrame) {
  LightFieldShape shape{2, 2, 300, 200, 8};
  EncodeParams params;
  params.block_size = 2;
  params.threads = 1;
  RenderPair pair(device(), encode(test::textured_light_field(shape, 1, 4), params)->bytes);
  ASSERT_FALSE(pair.closed());
  Camera camera;
  camera.position = WorldPoint{0.5, 0.5, 0};
  const auto record = frame_record(camera, pair.header());
  ASSERT_TRUE(record) << record.error().message;
  FrameTally tally;
  pair.compare(*record, 0, tally);
  EXPECT_EQ(tally.repeated, 1u);
  pair.compare(*record, 0, tally);
  EXPECT_EQ(tally.repeated, 1u) << "the room is kept";
  EXPECT_EQ(tally.lit, 2u);
}

TEST_F(GpuRendering, RefusesAFrameOfAnotherLightField) {
  RenderPair pair(device(), test::random_stream(3));
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
