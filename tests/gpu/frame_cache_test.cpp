// Frames that reuse blocks of the frames before: the golden renderer's bytes and errors, and the
// blocks that the rule of docs/gpu.md predicts, with budgets from nothing to everything.
#include <algorithm>

#include "decoder/open_stream.hpp"
#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "gpu/render_pair.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kPlenty = uint64_t{1} << 24;  // bytes; more than a small stream has

class GpuFrameCache : public GpuTest {};

/// Walks before the streams of `seeds` with a cache of `bytes` bytes.
FrameTally walk_all(Device& device, uint64_t cache_bytes, uint32_t first, uint32_t last,
                    bool damaged) {
  FrameTally tally;
  for (uint32_t seed = first; seed < last; ++seed) {
    auto bytes = test::random_stream(seed);
    if (damaged) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    RenderPair pair(device, std::move(bytes), cache_bytes);
    if (pair.closed()) continue;
    EXPECT_EQ(difference_of_walk(pair, seed, 10, tally), "")
        << "seed " << seed << ", cache " << cache_bytes;
    if (testing::Test::HasFailure()) break;
  }
  return tally;
}

TEST_F(GpuFrameCache, NeverChangesAFrameWhateverItsBudget) {
  const FrameTally nothing = walk_all(device(), 0, 12, 26, false);
  EXPECT_EQ(nothing.decoded, nothing.needed);
  const FrameTally little = walk_all(device(), 4096, 12, 26, false);
  const FrameTally more = walk_all(device(), 16384, 12, 26, false);
  const FrameTally plenty = walk_all(device(), kPlenty, 12, 26, false);
  EXPECT_EQ(plenty.needed, nothing.needed);
  EXPECT_LT(little.decoded, nothing.decoded);
  EXPECT_LT(more.decoded, little.decoded);
  EXPECT_LT(plenty.decoded, more.decoded);
  EXPECT_LT(plenty.decoded, plenty.needed / 2);
  EXPECT_GT(plenty.lit, 40u);
  EXPECT_GT(plenty.coarse, 10u);
  EXPECT_GT(plenty.displaced, 5u);
}

TEST_F(GpuFrameCache, NeverHoldsABlockWithAnError) {
  const FrameTally tally = walk_all(device(), kPlenty, 200, 240, true);
  EXPECT_GT(tally.failed, 50u);
  EXPECT_GT(tally.lit, 50u);
  EXPECT_LT(tally.decoded, tally.needed);
}

class GpuFrameCacheOfOneStream : public GpuFrameCache {
 protected:
  /// Between the four views, which all have weight.
  static FrameRecord record(const StreamHeader& header) {
    Camera camera;
    camera.position = WorldPoint{0.5, 0.5, 0};
    return *frame_record(camera, header);
  }
};

TEST_F(GpuFrameCacheOfOneStream, ARepeatedFrameDecodesNothing) {
  RenderPair pair(device(), stream_of_many_blocks(), kPlenty);
  ASSERT_FALSE(pair.closed());
  const FrameRecord frame = record(pair.header());
  FrameTally tally;
  pair.compare(frame, 0, tally);
  const uint64_t needed = pair.last().blocks_needed;
  EXPECT_GT(needed, 16384u);
  EXPECT_EQ(pair.last().blocks_decoded, needed);
  EXPECT_EQ(pair.last().submissions, 2u);
  pair.compare(frame, 0, tally);
  EXPECT_EQ(pair.last().blocks_decoded, 0u);
  EXPECT_EQ(pair.last().submissions, 1u);
  pair.forget();
  pair.compare(frame, 0, tally);
  EXPECT_EQ(pair.last().blocks_decoded, needed);
  EXPECT_EQ(pair.last().submissions, 1u) << "the room is kept";
}

TEST_F(GpuFrameCacheOfOneStream, AnotherStopLevelBeginsAnew) {
  RenderPair pair(device(), stream_of_many_blocks(), kPlenty);
  ASSERT_FALSE(pair.closed());
  const FrameRecord frame = record(pair.header());
  FrameTally tally;
  for (const int stop_level : {0, 1, 0}) {
    pair.compare(frame, stop_level, tally);
    EXPECT_EQ(pair.last().blocks_decoded, pair.last().blocks_needed);
  }
  pair.compare(frame, 0, tally);
  EXPECT_EQ(pair.last().blocks_decoded, 0u);
}

// A budget of as many bytes as the frame's blocks take, or one less.
TEST_F(GpuFrameCacheOfOneStream, AFrameAboveTheBudgetLeavesNothing) {
  const uint64_t blocks = uint64_t{4} * (150 * 100 + 2 * 75 * 50);
  const uint64_t frame_bytes = (blocks + 31) / 32 * 32 * 4 * sizeof(int16_t);
  for (const uint64_t missing : {0u, 1u}) {
    RenderPair pair(device(), stream_of_many_blocks(), frame_bytes - missing);
    ASSERT_FALSE(pair.closed());
    const FrameRecord frame = record(pair.header());
    FrameTally tally;
    pair.compare(frame, 0, tally);
    pair.compare(frame, 0, tally);
    EXPECT_EQ(pair.last().blocks_needed, blocks);
    EXPECT_EQ(pair.last().blocks_decoded, missing * blocks);
    EXPECT_EQ(tally.repeated, 1u) << "the room is kept";
  }
}

// A camera that opens up: each frame needs more blocks than the one before. Room for twice as many
// is made at a time, from 16384 to 90000 blocks and from 512 to 2813 pages: three times each at
// most.
TEST_F(GpuFrameCacheOfOneStream, ACameraThatNeedsEverMoreIsSubmittedAgainRarely) {
  const auto stream = stream_of_many_blocks();
  const auto view = open_stream(stream, {});
  ASSERT_TRUE(view);
  auto renderer = GpuRenderer::open(device(), *view, 0);
  ASSERT_TRUE(renderer);
  Camera camera;
  camera.position = WorldPoint{0.5, 0.5, 0};
  uint64_t most = 0;
  unsigned larger = 0;
  unsigned repeated = 0;
  for (int step = 0; step <= 10; ++step) {
    camera.tan_half = 0.2 + 0.03 * step;
    const auto frame = renderer->render(*frame_record(camera, view->header), 0);
    ASSERT_TRUE(frame);
    if (frame->blocks_needed > most) ++larger;
    most = std::max(most, frame->blocks_needed);
    repeated += frame->submissions - 1;
  }
  EXPECT_EQ(larger, 11u);
  EXPECT_GT(most, 80000u);
  EXPECT_GE(repeated, 3u);
  EXPECT_LE(repeated, 6u);
}

}  // namespace
}  // namespace hmlfc::gpu
