// Barriers: the check of hazards itself, and that no barrier of the library can be left out.
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <hmlfc/gpu/recording.hpp>
#include <hmlfc/gpu/renderer.hpp>

#include "batch_buffers.hpp"
#include "block_stages.hpp"
#include "decoder/open_stream.hpp"
#include "device_state.hpp"
#include "gpu/gpu_test.hpp"
#include "hazards.hpp"
#include "render/render_cases.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kBuffer = 0x1000;
constexpr uint64_t kOther = 0x2000;

BufferAccess reads(uint64_t buffer) { return {buffer, "it", true, false}; }
BufferAccess writes(uint64_t buffer) { return {buffer, "it", false, true}; }

// A submission that has begun, with its first barrier.
Hazards begun() {
  Hazards hazards;
  hazards.begin();
  hazards.barrier(kCompute | kTransfer, kCompute | kTransfer);
  return hazards;
}

void add(Hazards& hazards, const std::string& command, Work work, const BufferAccess& access) {
  hazards.command(command);
  hazards.access(work, access);
}

TEST(Hazards, OfAWriteAndAReadNeedABarrierOfTheirWork) {
  for (const unsigned before : {0u, unsigned{kCompute}, unsigned{kTransfer}}) {
    for (const unsigned after : {0u, unsigned{kCompute}, unsigned{kTransfer}}) {
      Hazards hazards = begun();
      add(hazards, "a", kCompute, writes(kBuffer));
      hazards.barrier(before, after);
      add(hazards, "b", kTransfer, reads(kBuffer));
      EXPECT_EQ(hazards.end().empty(), before == kCompute && after == kTransfer);
    }
  }
}

TEST(Hazards, AreNamedWithBothCommands) {
  Hazards hazards = begun();
  add(hazards, "walk", kCompute, writes(kBuffer));
  add(hazards, "samples", kCompute, reads(kBuffer));
  EXPECT_EQ(hazards.end(),
            "samples reads it, which walk writes, without a barrier from compute to compute");
}

TEST(Hazards, AreWritesAfterReadsAndAfterWrites) {
  for (const BufferAccess& first : {reads(kBuffer), writes(kBuffer)}) {
    Hazards hazards = begun();
    add(hazards, "a", kCompute, first);
    add(hazards, "b", kCompute, writes(kBuffer));
    EXPECT_NE(hazards.end(), "");
  }
}

TEST(Hazards, AreNotReadsAloneNorOtherBytes) {
  Hazards hazards = begun();
  add(hazards, "a", kCompute, reads(kBuffer));
  add(hazards, "b", kTransfer, reads(kBuffer));
  add(hazards, "c", kTransfer, writes(kOther));
  add(hazards, "d", kTransfer, {kBuffer + 8, "it", false, true, 0, 4});
  add(hazards, "e", kTransfer, {kBuffer + 8, "it", false, true, 4, 8});
  EXPECT_EQ(hazards.end(), "");
}

TEST(Hazards, OfPartsAreThoseOfTheWhole) {
  Hazards hazards = begun();
  hazards.join(kOther, kBuffer, 4);
  add(hazards, "a", kTransfer, {kOther, "it", false, true, 0, 4});
  add(hazards, "b", kCompute, {kBuffer, "it", true, false, 0, 4});
  EXPECT_EQ(hazards.end(), "");
  add(hazards, "c", kCompute, {kBuffer, "it", true, false, 4, 8});
  EXPECT_NE(hazards.end(), "");
}

TEST(Hazards, OfEarlierSubmissionsAreThoseOfTheirWrites) {
  for (const bool visible : {false, true}) {
    Hazards hazards = begun();
    add(hazards, "a", kCompute, reads(kOther));
    add(hazards, "a", kCompute, writes(kBuffer));
    EXPECT_EQ(hazards.end(), "");
    hazards.finished(1);
    hazards.begin();
    hazards.barrier(visible ? kCompute : kTransfer, kCompute);
    add(hazards, "b", kCompute, writes(kOther));
    add(hazards, "b", kCompute, reads(kBuffer));
    EXPECT_EQ(hazards.end().empty(), visible);
  }
}

// What was read, and what was written, by a submission that may still be under way.
TEST(Hazards, OfWritesAfterSubmissionsUnderWay) {
  for (const BufferAccess& before : {reads(kBuffer), writes(kBuffer)}) {
    for (const bool finished : {false, true}) {
      for (const bool ordered : {false, true}) {
        Hazards hazards = begun();
        add(hazards, "a", kCompute, before);
        EXPECT_EQ(hazards.end(), "");
        if (finished) hazards.finished(1);
        hazards.begin();
        hazards.barrier(ordered ? kCompute : kTransfer, kCompute);
        add(hazards, "b", kCompute, writes(kBuffer));
        EXPECT_EQ(hazards.end().empty(), finished || ordered);
      }
    }
  }
}

TEST(Hazards, EndWithABufferOfTheSameAddress) {
  Hazards hazards = begun();
  add(hazards, "a", kCompute, writes(kBuffer));
  hazards.add_buffer(kBuffer);
  add(hazards, "b", kCompute, reads(kBuffer));
  EXPECT_EQ(hazards.end(), "");
}

TEST(Hazards, NameIdleBarriers) {
  Hazards hazards = begun();
  add(hazards, "a", kCompute, writes(kBuffer));
  hazards.barrier(kCompute | kTransfer, kCompute);
  add(hazards, "b", kCompute, reads(kBuffer));
  EXPECT_EQ(hazards.end(), "nothing needs that the barrier behind a waits for transfer");
  hazards.begin();
  hazards.barrier(kCompute, kCompute);
  add(hazards, "a", kCompute, writes(kBuffer));
  hazards.barrier(kCompute, kCompute);
  hazards.barrier(kCompute, kCompute);
  add(hazards, "b", kCompute, reads(kBuffer));
  EXPECT_NE(hazards.end(), "");
}

class GpuBarriers : public GpuTest {
 public:
  /// Makes submissions of one kind last; what is wrong, or nothing.
  using Body = std::function<std::string(Device&, const StreamView&)>;

  /// Every part of the barriers of the last submission of `body` is needed, from barrier `first`
  /// on. There are `barriers`.
  static void expect_all_needed(const Body& body, unsigned first, size_t barriers) {
    const auto bytes = stream_with_references();
    const auto view = open_stream(bytes, {});
    ASSERT_TRUE(view);
    Device::State& state = device().state();
    ASSERT_EQ(body(device(), *view), "");
    const auto scopes = state.hazards->scopes();
    ASSERT_EQ(scopes.size(), barriers);
    const auto expect_refused = [&](const BarrierFault& fault) {
      state.barrier_fault = fault;
      const std::string message = body(device(), *view);
      state.barrier_fault.reset();
      EXPECT_NE(message.find("without a barrier"), std::string::npos)
          << "barrier " << fault.number << " less " << fault.before << " to " << fault.after << ": "
          << message;
    };
    for (unsigned number = first; number < scopes.size(); ++number) {
      for (const unsigned work : {kCompute, kTransfer, kIndirect, kHost}) {
        if ((scopes[number].before & work) != 0) expect_refused({number, work, 0});
        if ((scopes[number].after & work) != 0) expect_refused({number, 0, work});
      }
    }
  }

 private:
  // Some of its reference images are decoded on the device.
  static std::vector<uint8_t> stream_with_references() {
    for (uint32_t seed = 0;; ++seed) {
      auto bytes = tb::suite_stream(seed, 4);
      const auto view = open_stream(bytes, {});
      if (view && !reference_batches(view->geometry, 1u << 16).empty()) return bytes;
    }
  }
};

// Nothing but copies is before the only submission.
TEST_F(GpuBarriers, OfReferenceImagesAreAllNeeded) {
  expect_all_needed(
      [](Device& device, const StreamView& view) {
        const auto decoder = GpuDecoder::open(device, view);
        return decoder ? std::string() : decoder.error().message;
      },
      1, 3);
}

TEST_F(GpuBarriers, OfPixelsAreAllNeeded) {
  expect_all_needed(
      [](Device& device, const StreamView& view) {
        auto decoder = GpuDecoder::open(device, view);
        if (!decoder) return decoder.error().message;
        const PixelArea area{{0, 0}};
        for (int i = 0; i < 2; ++i) {
          const auto blocks = decoder->decode_rgb({&area, 1});
          if (!blocks) return blocks.error().message;
        }
        return std::string();
      },
      0, 6);
}

// Commands that may run again before they are done.
TEST_F(GpuBarriers, OfRecordingsAreAllNeeded) {
  expect_all_needed(
      [](Device& device, const StreamView& view) {
        const auto decoder = GpuDecoder::open(device, view);
        if (!decoder) return decoder.error().message;
        Device::State& state = device.state();
        const Buffer target(state, 1024, Memory::kDevice);
        const vk::raii::CommandBuffers buffers(
            *state.device,
            vk::CommandBufferAllocateInfo(**state.pool, vk::CommandBufferLevel::ePrimary, 1));
        buffers.front().begin(vk::CommandBufferBeginInfo());
        const PixelArea area{{0, 0}};
        const auto recording =
            record(*decoder, *buffers.front(), {&area, 1}, BufferTarget{target.handle(), 0});
        return recording ? std::string() : recording.error().message;
      },
      0, 6);
}

// The second of two recorded frames that may be under way at once.
TEST_F(GpuBarriers, OfRecordedFramesAreAllNeededAndSix) {
  expect_all_needed(
      [](Device& device, const StreamView& view) {
        auto renderer = GpuRenderer::open(device, view, 1u << 20);
        if (!renderer) return renderer.error().message;
        Device::State& state = device.state();
        const FrameRecord frame = *frame_record(Camera{}, view.header);
        const uint64_t bytes = uint64_t{8} * view.header.width * view.header.height;
        const Buffer targets[] = {{state, bytes, Memory::kDevice}, {state, bytes, Memory::kDevice}};
        const vk::raii::CommandBuffers buffers(
            *state.device,
            vk::CommandBufferAllocateInfo(**state.pool, vk::CommandBufferLevel::ePrimary, 2));
        std::array<FrameRecording, 2> recordings;
        for (size_t i = 0; i < 2; ++i) {
          buffers[i].begin(vk::CommandBufferBeginInfo());
          const auto recorded = record(*renderer, *buffers[i], frame, 0,
                                       BufferTarget{targets[i].handle(), 0}, recordings[i]);
          if (!recorded) return recorded.error().message;
        }
        return std::string();
      },
      0, 6);
}

TEST_F(GpuBarriers, OfStagesAreAllNeeded) {
  expect_all_needed(
      [](Device& device, const StreamView& view) {
        auto decoder = GpuDecoder::open(device, view);
        if (!decoder) return decoder.error().message;
        const BlockArea area{{0, 0}};
        for (int i = 0; i < 2; ++i) {
          const auto blocks = decoder->trace({&area, 1});
          if (!blocks) return blocks.error().message;
        }
        return std::string();
      },
      0, 5);
}

// The second of two frames under way, after one that was finished in the second's place.
std::string frames(Device& device, const StreamView& view, FrameOutput output,
                   GeometrySource geometry) {
  auto renderer = GpuRenderer::open(device, view, 1u << 20);
  if (!renderer) return renderer.error().message;
  test::Random random(1);
  GpuFrame frame;
  for (int begun = 0; begun < 5;) {
    Camera camera = test::random_camera(random, view.header);
    camera.aperture = 0;
    camera.geometry = geometry;
    const auto record = frame_record(camera, view.header);
    if (!record) continue;
    const auto started = renderer->begin(*record, 0, output);
    if (!started) return started.error().message;
    ++begun;
    if (renderer->under_way() < 2 || begun == 5) continue;
    const auto finished = renderer->finish(frame);
    if (!finished) return finished.error().message;
  }
  return {};
}

void expect_barriers_of_frames(FrameOutput output, GeometrySource geometry, size_t barriers) {
  GpuBarriers::expect_all_needed(
      [=](Device& device, const StreamView& view) {
        return frames(device, view, output, geometry);
      },
      0, barriers);
}

TEST_F(GpuBarriers, OfFramesForTheDeviceAreAllNeededAndSix) {
  expect_barriers_of_frames(FrameOutput::kDevice, GeometrySource::kPlane, 6);
}

TEST_F(GpuBarriers, OfFramesForTheHostAreAllNeeded) {
  expect_barriers_of_frames(FrameOutput::kHost, GeometrySource::kPlane, 7);
}

TEST_F(GpuBarriers, OfFramesWithGeometryAreAllNeededAndSeven) {
  expect_barriers_of_frames(FrameOutput::kDevice, GeometrySource::kStream, 7);
}

}  // namespace
}  // namespace hmlfc::gpu
