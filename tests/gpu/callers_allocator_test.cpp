// Device memory from the program.
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/gpu/renderer.hpp>
#include <hmlfc/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "device_state.hpp"
#include "gpu/callers_allocator.hpp"
#include "gpu/callers_test.hpp"
#include "gpu/frame_cases.hpp"

namespace hmlfc::gpu {
namespace {

VKAPI_ATTR VkResult VKAPI_CALL allocate_nothing(VkDevice, const VkMemoryAllocateInfo*,
                                                const VkAllocationCallbacks*, VkDeviceMemory*) {
  return VK_ERROR_UNKNOWN;
}

class GpuCallersMemory : public CallersTest {
 protected:
  void SetUp() override {
    CallersTest::SetUp();
    if (!IsSkipped()) allocator_.emplace(callers());
  }

  CallersAllocator& allocator() { return *allocator_; }

  /// On the program's memory alone: the library's own calls for memory fail.
  Device open_on_allocator() {
    VulkanDevice handles = callers().handles();
    handles.memory = allocator().callbacks();
    DeviceOptions options;
    options.cache_folder = "";
    Device device = *open_device(handles, options);
    auto* calls = device.state().device->getDispatcher();
    const_cast<std::remove_const_t<std::remove_pointer_t<decltype(calls)>>&>(*calls)
        .vkAllocateMemory = &allocate_nothing;
    return device;
  }

  void expect_all_back() {
    EXPECT_GT(allocator().given(), 20u);
    EXPECT_EQ(allocator().live(), 0u);
    EXPECT_EQ(allocator().wrong(), 0u);
  }

 private:
  std::optional<CallersAllocator> allocator_;
};

TEST_F(GpuCallersMemory, IsAllThatBuffersTake) {
  {
    Device device = open_on_allocator();
    for (uint32_t seed = 0; seed < 4; ++seed) {
      expect_equal(device, stream_of(seed), {.requests = 60, .seed = seed});
    }
    FrameTally tally;
    EXPECT_EQ(difference_of_scenes(device, 2, tb::Damage::kNone, 16384, tally), "");
    EXPECT_GT(tally.displaced, 10u);
  }
  expect_all_back();
}

TEST_F(GpuCallersMemory, NeedsBothFunctions) {
  for (const bool allocates : {false, true}) {
    VulkanDevice handles = callers().handles();
    handles.memory = allocator().callbacks();
    if (allocates) {
      handles.memory.free = nullptr;
    } else {
      handles.memory.allocate = nullptr;
    }
    const auto opened = open_device(handles);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().kind, FailureKind::kUnusable);
    EXPECT_NE(opened.error().message.find("without the other"), std::string::npos);
  }
}

// Calls `call` with room for 0, 1, 2, ... more pieces until it succeeds: all other calls say that
// there was none.
template <class Call>
unsigned failures_of(CallersAllocator& allocator, const Call& call) {
  for (unsigned pieces = 0;; ++pieces) {
    allocator.allow(pieces);
    const auto outcome = call();
    allocator.allow(UINT64_MAX);
    if (outcome || testing::Test::HasFailure()) return pieces;
    EXPECT_EQ(outcome.error().kind, FailureKind::kOutOfMemory) << outcome.error().message;
  }
}

// Whichever piece is missing: the call fails, leaves nothing behind, and the next one is as if it
// had not been.
TEST_F(GpuCallersMemory, ThatEndsIsAFailureAndNoMore) {
  const test::OpenedStream stream(stream_of_many_blocks());
  Camera camera;
  camera.position = WorldPoint{0.5, 0.5, 0};
  const FrameRecord record = *frame_record(camera, stream.decoder->header());
  Frame expected;
  ASSERT_TRUE(make_golden_renderer(*stream.decoder)->render(record, 0, expected));
  {
    Device device = open_on_allocator();
    std::optional<GpuRenderer> renderer;
    EXPECT_GT(failures_of(allocator(),
                          [&] {
                            auto opened = GpuRenderer::open(device, *stream.decoder, 0);
                            if (opened) renderer.emplace(*opened);
                            return opened;
                          }),
              10u);
    // It takes more room than there is at first.
    std::optional<GpuFrame> frame;
    EXPECT_GT(failures_of(allocator(),
                          [&] {
                            auto drawn = renderer->render(record, 0);
                            if (drawn) frame.emplace(*drawn);
                            return drawn;
                          }),
              5u);
    EXPECT_EQ(frame->image.samples, expected.image.samples);
    auto decoder = GpuDecoder::open(device, *stream.decoder);
    ASSERT_TRUE(decoder);
    const PixelArea area{{1, 1}, 3, 4, 20, 9, 0};
    const auto before = decoder->decode_rgb({&area, 1});
    ASSERT_TRUE(before);
    const PixelArea larger{{1, 1}, 0, 0, 60, 50, 0};
    EXPECT_GT(failures_of(allocator(), [&] { return decoder->decode_rgb({&larger, 1}); }), 3u);
    EXPECT_EQ(decoder->decode_rgb({&area, 1})->samples, before->samples);
  }
  expect_all_back();
}

}  // namespace
}  // namespace hmlfc::gpu
