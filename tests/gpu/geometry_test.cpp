// Frames with geometry of scenes in depth against those of the golden renderer. Random streams,
// which tell little of depth, are in render_test.cpp.
#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

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

TEST_F(GpuGeometry, KeepsItsBounds) {
  DeviceOptions options;
  options.guard_pages = true;
  options.chunk_bytes = 1024;
  auto device = open(options);
  ASSERT_TRUE(device);
  FrameTally tally;
  EXPECT_EQ(difference_of_scenes(*device, 2, tb::Damage::kNone, 16384, tally), "");
  EXPECT_GT(tally.displaced, 10u);
}

}  // namespace
}  // namespace hmlfc::gpu
