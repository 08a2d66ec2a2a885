// Frames under way: the same frames as one at a time, in their order, and in the steady state
// without anything that costs the host.
#include <algorithm>
#include <iterator>

#include <hmlfc/gpu/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/allocation_count.hpp"
#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "render/render_cases.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kCacheBytes = uint64_t{1} << 24;

class GpuFrameRing : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped()) return;
    stream_.emplace(test::random_stream(3));
    records_ = small_frames(*stream_->decoder);
  }

  GpuRenderer open_renderer(Device& device) const {
    return std::move(*GpuRenderer::open(device, *stream_->decoder, kCacheBytes));
  }

  std::optional<test::OpenedStream> stream_;
  std::vector<FrameRecord> records_;
};

TEST_F(GpuFrameRing, GivesTheFramesOfOneAtATimeInTheirOrder) {
  std::vector<GpuFrame> expected;
  auto alone = open_renderer(device());
  for (const FrameRecord& record : records_) expected.push_back(*alone.render(record, 0));
  for (unsigned under_way = 1; under_way <= GpuRenderer::most_under_way(); ++under_way) {
    auto renderer = open_renderer(device());
    GpuFrame frame;
    size_t begun = 0;
    for (const GpuFrame& one : expected) {
      while (begun < records_.size() && renderer.under_way() < under_way) {
        ASSERT_TRUE(renderer.begin(records_[begun++], 0, FrameOutput::kHost));
      }
      ASSERT_TRUE(renderer.finish(frame));
      EXPECT_EQ(frame.status, one.status);
      EXPECT_EQ(frame.image.samples, one.image.samples);
      EXPECT_EQ(frame.blocks_needed, one.blocks_needed);
      EXPECT_EQ(frame.blocks_decoded, one.blocks_decoded);
      EXPECT_EQ(frame.disparities_looked_up, one.disparities_looked_up);
    }
    EXPECT_EQ(renderer.under_way(), 0u);
  }
}

// After a frame with an error nothing is held, also by a frame that has begun before it was known.
TEST_F(GpuFrameRing, ForgetsAfterErrorsThatTheHostDoesNotKnowYet) {
  unsigned failed = 0;
  for (uint32_t seed = 200; seed < 230; ++seed) {
    auto bytes = test::random_stream(seed);
    tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    OpenOptions unchecked;
    unchecked.check_sections = false;
    const auto view = open_stream(bytes, unchecked);
    if (!view) continue;
    test::Random random(seed);
    std::vector<FrameRecord> records;
    while (records.size() < 6) {
      const auto record = frame_record(test::random_camera(random, view->header), view->header);
      if (record) records.push_back(*record);
    }
    auto alone = GpuRenderer::open(device(), *view, kCacheBytes);
    auto ring = GpuRenderer::open(device(), *view, kCacheBytes);
    ASSERT_TRUE(alone && ring);
    GpuFrame frame;
    for (size_t i = 0; i < records.size(); i += GpuRenderer::most_under_way()) {
      for (size_t k = i; k < i + GpuRenderer::most_under_way(); ++k) {
        ASSERT_TRUE(ring->begin(records[k], 0, FrameOutput::kHost));
      }
      for (size_t k = i; k < i + GpuRenderer::most_under_way(); ++k) {
        const auto expected = alone->render(records[k], 0);
        ASSERT_TRUE(expected && ring->finish(frame));
        EXPECT_EQ(frame.status, expected->status);
        EXPECT_EQ(frame.blocks_decoded, expected->blocks_decoded);
        EXPECT_EQ(frame.image.samples, expected->image.samples);
        if (frame.status == ErrorCode::kOk) continue;
        ++failed;
        alone->forget();
      }
    }
  }
  EXPECT_GT(failed, 20u);
}

TEST_F(GpuFrameRing, RefusesAFrameTooManyAndFinishesNone) {
  auto renderer = open_renderer(device());
  GpuFrame frame;
  const auto none = renderer.finish(frame);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, FailureKind::kLimit);
  for (unsigned i = 0; i < GpuRenderer::most_under_way(); ++i) {
    ASSERT_TRUE(renderer.begin(records_[i], i == 1 ? 99 : 0, FrameOutput::kDevice));
  }
  const auto late = renderer.begin(records_[0], 0, FrameOutput::kDevice);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().kind, FailureKind::kLimit);
  for (unsigned i = 0; i < GpuRenderer::most_under_way(); ++i) {
    ASSERT_TRUE(renderer.finish(frame));
    EXPECT_EQ(frame.status, i == 1 ? ErrorCode::kBadRequest : ErrorCode::kOk);
    EXPECT_TRUE(frame.image.samples.empty());
  }
}

TEST_F(GpuFrameRing, MayBeClosedWithFramesUnderWay) {
  for (int i = 0; i < 3; ++i) {
    auto renderer = open_renderer(device());
    for (unsigned k = 0; k < GpuRenderer::most_under_way(); ++k) {
      ASSERT_TRUE(renderer.begin(records_[k], 0, FrameOutput::kHost));
    }
  }
  EXPECT_TRUE(open_renderer(device()).render(records_[0], 0));
}

// Renders `frames` frames as a program with a loop of its own does: it begins a frame where there
// is room, and finishes one where that is done.
uint64_t run_frames(GpuRenderer& renderer, const std::vector<FrameRecord>& records, size_t frames,
                    GpuFrame& frame) {
  uint64_t decoded = 0;
  for (size_t begun = 0, finished = 0; finished < frames;) {
    if (begun < frames && renderer.under_way() < GpuRenderer::most_under_way()) {
      if (!renderer.begin(records[begun++ % records.size()], 0, FrameOutput::kDevice)) return 0;
    }
    if (!*renderer.ready()) continue;
    if (!renderer.finish(frame)) return 0;
    decoded += frame.blocks_decoded;
    ++finished;
  }
  return decoded;
}

TEST_F(GpuFrameRing, CostsTheHostNothingInTheSteadyState) {
  auto device = open_unchecked({});
  ASSERT_TRUE(device);
  for (const int32_t geometry : {0, 1}) {
    std::vector<FrameRecord> records;
    std::ranges::copy_if(records_, std::back_inserter(records),
                         [&](const FrameRecord& record) { return record.geometry == geometry; });
    ASSERT_GT(records.size(), 2u);
    auto renderer = open_renderer(*device);
    GpuFrame frame;
    EXPECT_GT(run_frames(renderer, records, records.size() + GpuRenderer::most_under_way(), frame),
              0u);
    const SubmissionCounts before = device->counts();
    const uint64_t allocated = test::allocation_count();
    EXPECT_EQ(run_frames(renderer, records, 60, frame), 0u) << "nothing is missing";
    EXPECT_EQ(test::allocation_count() - allocated, 0u);
    const SubmissionCounts& after = device->counts();
    EXPECT_EQ(after.submitted - before.submitted, 60u);
    EXPECT_EQ(after.waits - before.waits, 0u);
    EXPECT_EQ(after.made - before.made, 0u);
    EXPECT_EQ(after.recorded - before.recorded, 0u);
  }
}

}  // namespace
}  // namespace hmlfc::gpu
