// Frames recorded into command buffers of the caller.
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <hmlfc/gpu/recording.hpp>
#include <hmlfc/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/allocation_count.hpp"
#include "gpu/frame_cases.hpp"
#include "gpu/program.hpp"
#include "render/render_cases.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kHeldBytes = uint64_t{1} << 24;
constexpr uint32_t kMostSide = 48;  // no frame of a test is wider or higher

class GpuFrameRecording : public ProgramTest {
 protected:
  /// What was compared.
  struct Tally {
    unsigned drawn = 0, failed = 0, coarse = 0, displaced = 0;
    std::set<std::pair<int, ChromaFormat>> kinds;
  };

  /// Frames of random cameras, three under way, with frames of the renderer's own between them.
  void compare(const std::vector<uint8_t>& bytes, uint32_t seed, Tally& tally) {
    OpenOptions unchecked;
    unchecked.check_sections = false;
    const test::OpenedStream stream(bytes, unchecked);
    if (!stream.decoder) return;
    const StreamHeader& header = stream.decoder->header();
    auto renderer = GpuRenderer::open(program(), *stream.decoder, kHeldBytes);
    ASSERT_TRUE(renderer) << renderer.error().message;
    const auto golden = make_golden_renderer(*stream.decoder);
    ProgramFrames ring(program(), uint64_t{8} * kMostSide * kMostSide);
    test::Random random(seed);
    std::vector<std::pair<FrameRecord, int>> frames;
    for (uint64_t number = 1; number <= 9; ++number) {
      Camera camera = test::random_camera_with_geometry(random, header);
      camera.frame_width = 1 + random() % kMostSide;
      camera.frame_height = 1 + random() % kMostSide;
      const auto frame = frame_record(camera, header);
      if (!frame) return;
      const auto levels = static_cast<uint32_t>(header.tree_height) + 1;
      frames.emplace_back(*frame, random() % 3 == 0 ? static_cast<int>(random() % levels) : 0);
      const auto drawn = ring.draw(*renderer, frames.back().first, frames.back().second);
      ASSERT_TRUE(drawn) << drawn.error().message;
      if (number % ProgramFrames::kUnderWay != 0) continue;
      for (uint64_t k = number - 2; k <= number; ++k) {
        expect_golden(ring, k, *golden, frames[k - 1], header, tally);
      }
      if (number == 6) expect_rendered(*renderer, *golden, frames[random() % frames.size()]);
    }
  }

 private:
  static void expect_golden(ProgramFrames& ring, uint64_t number, FrameRenderer& golden,
                            const std::pair<FrameRecord, int>& frame, const StreamHeader& header,
                            Tally& tally) {
    Frame expected;
    const auto drawn = golden.render(frame.first, frame.second, expected);
    const RecordedFrame result = ring.result(number);
    EXPECT_TRUE(result.had_room);
    EXPECT_EQ(result.status, drawn ? ErrorCode::kOk : drawn.error().code);
    if (drawn) {
      EXPECT_EQ(result.blocks_needed, expected.counts.blocks_needed);
    }
    const auto texels = texels_of(drawn, expected, frame.first, header);
    const size_t bytes = texels.size() * texel_bytes(header) / 4;
    EXPECT_EQ(samples_of(ring.texels(number).first(bytes), header), texels);
    ++(drawn ? tally.drawn : tally.failed);
    if (drawn && frame.second > 0) ++tally.coarse;
    if (result.disparities_looked_up > 0) ++tally.displaced;
    tally.kinds.emplace(header.depth == 8 ? 8 : 16, header.chroma_format);
  }

  static void expect_rendered(GpuRenderer& renderer, FrameRenderer& golden,
                              const std::pair<FrameRecord, int>& frame) {
    Frame expected;
    const auto drawn = golden.render(frame.first, frame.second, expected);
    const auto own = renderer.render(frame.first, frame.second);
    ASSERT_TRUE(own);
    EXPECT_EQ(own->status, drawn ? ErrorCode::kOk : drawn.error().code);
    if (drawn) {
      EXPECT_EQ(own->image.samples, expected.image.samples);
    }
  }
};

TEST_F(GpuFrameRecording, IsTheGoldenRenderersFrame) {
  Tally tally;
  for (uint32_t seed = 0; seed < 20; ++seed) compare(stream_of(seed), seed, tally);
  for (uint32_t seed = 200; seed < 212; ++seed) {
    auto bytes = test::random_stream(seed);
    tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    compare(bytes, seed, tally);
  }
  EXPECT_GT(tally.drawn, 60u);
  EXPECT_GT(tally.failed, 5u);
  EXPECT_GT(tally.coarse, 5u);
  EXPECT_GT(tally.displaced, 5u);
  EXPECT_EQ(tally.kinds.size(), 4u);
}

class GpuFrameRecordingOfOneStream : public GpuFrameRecording {
 protected:
  void SetUp() override {
    GpuFrameRecording::SetUp();
    if (IsSkipped()) return;
    for (uint32_t seed = 0; !stream_ || header().tree_height == 0; ++seed) {
      stream_.emplace(test::random_stream(seed));
    }
    records_ = small_frames(*stream_->decoder);
  }

  const StreamHeader& header() const { return stream_->decoder->header(); }
  const std::vector<FrameRecord>& records() const { return records_; }
  GpuRenderer open_renderer(Device& device) const {
    return std::move(*GpuRenderer::open(device, *stream_->decoder, kHeldBytes));
  }
  std::vector<uint16_t> golden_texels(const FrameRecord& record, int stop_level) const {
    Frame frame;
    const auto drawn = make_golden_renderer(*stream_->decoder)->render(record, stop_level, frame);
    return texels_of(drawn, frame, record, header());
  }

 private:
  std::optional<test::OpenedStream> stream_;
  std::vector<FrameRecord> records_;
};

// Of the second layer; nothing else changes.
TEST_F(GpuFrameRecordingOfOneStream, GoesToItsPlaceInAnImage) {
  auto renderer = open_renderer(program());
  const ProgramImage image(program(), 64, header());
  const Buffer texels_read = target(uint64_t{2} * 64 * 64 * texel_bytes(header()));
  const TexelPlace place{7, 5, 1};
  FrameRecording recording;
  ProgramCommands(program(), [&](const vk::raii::CommandBuffer& commands) {
    image.clear(commands);
    ImageTarget to;
    to.image = image.handle();
    const auto none = record(renderer, *commands, records()[0], 0, to, recording);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("0 places for a frame"), std::string::npos);
    to.places = {&place, 1};
    const auto recorded = record(renderer, *commands, records()[0], 0, to, recording);
    ASSERT_TRUE(recorded) << recorded.error().message;
    image.read(commands, texels_read.handle());
  }).run();
  const auto texels = golden_texels(records()[0], 0);
  std::vector<uint16_t> samples(size_t{2} * 64 * 64 * 4);
  for (size_t y = 0; y < 30; ++y) {
    std::copy_n(texels.begin() + static_cast<ptrdiff_t>(y * 160), 160,
                samples.begin() + static_cast<ptrdiff_t>(4 * ((64 + 5 + y) * 64 + 7)));
  }
  EXPECT_EQ(samples_of(texels_read.bytes(), header()), samples);
  EXPECT_EQ(recording.result().status, ErrorCode::kOk);
}

// The device knows of which level the held blocks are, in whatever order commands run.
TEST_F(GpuFrameRecordingOfOneStream, RunsInAnotherOrderThanRecordedAndAgain) {
  auto renderer = open_renderer(program());
  const size_t bytes = size_t{40} * 30 * texel_bytes(header());
  std::array<FrameRecording, 2> recordings;
  std::vector<Buffer> targets;
  std::vector<ProgramCommands> commands;
  for (const size_t level : {0u, 1u}) {
    targets.push_back(target(bytes));
    commands.emplace_back(program(), [&](const vk::raii::CommandBuffer& buffer) {
      ASSERT_TRUE(record(renderer, *buffer, records()[0], static_cast<int>(level),
                         BufferTarget{targets.back().handle(), 0}, recordings.at(level)));
    });
  }
  for (const size_t level : {1u, 0u, 0u, 1u, 0u}) {
    std::ranges::fill(targets[level].bytes(), uint8_t{0xEE});
    commands[level].run();
    EXPECT_EQ(samples_of(targets[level].bytes(), header()),
              golden_texels(records()[0], static_cast<int>(level)));
  }
  EXPECT_EQ(recordings[0].result().blocks_decoded, recordings[0].result().blocks_needed);
}

TEST_F(GpuFrameRecordingOfOneStream, CostsTheHostNothingInTheSteadyState) {
  auto device = open_unchecked({});
  ASSERT_TRUE(device);
  auto renderer = open_renderer(*device);
  ProgramFrames ring(*device, uint64_t{8} * kMostSide * kMostSide);
  for (const FrameRecord& record : records()) ASSERT_TRUE(ring.draw(renderer, record, 0));
  const SubmissionCounts before = device->counts();
  const uint64_t allocated = test::allocation_count();
  for (size_t i = 0; i < 60; ++i) {
    ASSERT_TRUE(ring.draw(renderer, records()[i % records().size()], 0));
  }
  EXPECT_EQ(test::allocation_count() - allocated, 0u);
  const SubmissionCounts& after = device->counts();
  EXPECT_EQ(after.recorded - before.recorded, 60u);
  EXPECT_EQ(after.submitted - before.submitted, 0u);
  EXPECT_EQ(after.waits - before.waits, 0u);
  EXPECT_EQ(after.made - before.made, 0u);
}

TEST_F(GpuFrameRecordingOfOneStream, ThatDoesNotFitRecordsNothing) {
  auto renderer = open_renderer(program());
  ProgramFrames ring(program(), uint64_t{8} * kMostSide * kMostSide);
  EXPECT_EQ(FrameRecording().result().status, ErrorCode::kBadRequest);
  ring.fill(0xEE);
  const auto number = ring.draw(renderer, records()[0], 99);
  ASSERT_TRUE(number);
  EXPECT_EQ(ring.result(*number).status, ErrorCode::kBadRequest);
  EXPECT_TRUE(std::ranges::all_of(ring.texels(*number), [](uint8_t b) { return b == 0xEE; }));
}

TEST_F(GpuFrameRecording, WithoutRoomDrawsNothingUntilRenderMakesSome) {
  const test::OpenedStream stream(stream_of_many_blocks());
  const StreamHeader& header = stream.decoder->header();
  Camera camera;
  camera.position = WorldPoint{0.5, 0.5, 0};
  const FrameRecord frame = *frame_record(camera, header);
  auto renderer = GpuRenderer::open(program(), *stream.decoder, kHeldBytes);
  ASSERT_TRUE(renderer);
  ProgramFrames ring(program(), uint64_t{4} * 300 * 200);
  ring.fill(0xEE);
  const auto first = ring.draw(*renderer, frame, 0);
  ASSERT_TRUE(first);
  EXPECT_FALSE(ring.result(*first).had_room);
  EXPECT_TRUE(std::ranges::all_of(ring.texels(*first), [](uint8_t b) { return b == 0; }));
  const auto own = renderer->render(frame, 0);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->submissions, 2u);
  const auto second = ring.draw(*renderer, frame, 0);
  ASSERT_TRUE(second);
  EXPECT_TRUE(ring.result(*second).had_room);
  EXPECT_EQ(ring.result(*second).blocks_decoded, 0u) << "render() has left them";
  Frame expected;
  const auto drawn = make_golden_renderer(*stream.decoder)->render(frame, 0, expected);
  EXPECT_EQ(samples_of(ring.texels(*second), header), texels_of(drawn, expected, frame, header));
}

}  // namespace
}  // namespace hmlfc::gpu
