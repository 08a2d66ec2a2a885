// Device memory from the program.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <hmlfc/gpu/renderer.hpp>
#include <hmlfc/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "device/device_state.hpp"
#include "gpu/callers_device.hpp"
#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kBlockBytes = uint64_t{8} << 20;

/// Pieces one after the other in blocks of memory. Every piece must come back.
class CallersAllocator {
 public:
  explicit CallersAllocator(const CallersDevice& callers) : callers_(&callers) {}
  CallersAllocator(const CallersAllocator&) = delete;
  CallersAllocator& operator=(const CallersAllocator&) = delete;

  MemoryCallbacks callbacks();

  /// The next `pieces` are given, and none after them until this is called again.
  void allow(uint64_t pieces) { allowed_ = pieces; }

  uint64_t given() const { return given_; }
  uint64_t refused() const { return refused_; }
  uint64_t live() const { return live_.size(); }

  /// Pieces that came back and were not given, or with other content than given.
  uint64_t wrong() const { return wrong_; }

 private:
  struct Block {
    vk::raii::DeviceMemory memory;
    uint8_t* mapped;
    uint64_t used;
    uint64_t bytes;
  };

  static VkResult allocate(void* user, const VkMemoryRequirements& needs,
                           VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                           MemoryPiece& piece);
  static void free(void* user, const MemoryPiece& piece);

  uint32_t type_of(uint32_t allowed, VkMemoryPropertyFlags required,
                   VkMemoryPropertyFlags preferred) const;
  Block& block_for(uint32_t type, const VkMemoryRequirements& needs);

  const CallersDevice* callers_;
  std::map<uint32_t, std::vector<Block>> blocks_;  // by memory type
  std::map<uint64_t, std::pair<VkDeviceMemory, uint64_t>> live_;
  uint64_t allowed_ = UINT64_MAX;
  uint64_t given_ = 0, refused_ = 0, wrong_ = 0;
};

MemoryCallbacks CallersAllocator::callbacks() { return {this, &allocate, &free}; }

uint32_t CallersAllocator::type_of(uint32_t allowed, VkMemoryPropertyFlags required,
                                   VkMemoryPropertyFlags preferred) const {
  const auto properties = callers_->physical().getMemoryProperties();
  for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
      const auto has = static_cast<VkMemoryPropertyFlags>(properties.memoryTypes[i].propertyFlags);
      if ((allowed >> i & 1u) != 0 && (has & wanted) == wanted) return i;
    }
  }
  throw std::runtime_error("no such memory");
}

CallersAllocator::Block& CallersAllocator::block_for(uint32_t type,
                                                     const VkMemoryRequirements& needs) {
  auto& blocks = blocks_[type];
  if (blocks.empty() || blocks.back().used + needs.alignment + needs.size > blocks.back().bytes) {
    const uint64_t bytes = std::max(kBlockBytes, needs.alignment + needs.size);
    const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
    vk::raii::DeviceMemory memory(callers_->device(), vk::MemoryAllocateInfo(bytes, type, &flags));
    const auto properties = callers_->physical().getMemoryProperties().memoryTypes[type];
    const bool visible = bool(properties.propertyFlags & vk::MemoryPropertyFlagBits::eHostVisible);
    auto* mapped = visible ? static_cast<uint8_t*>(memory.mapMemory(0, VK_WHOLE_SIZE)) : nullptr;
    // No piece begins where its memory does.
    blocks.push_back({std::move(memory), mapped, 1, bytes});
  }
  return blocks.back();
}

VkResult CallersAllocator::allocate(void* user, const VkMemoryRequirements& needs,
                                    VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                                    MemoryPiece& piece) {
  auto& self = *static_cast<CallersAllocator*>(user);
  if (self.allowed_ == 0) {
    ++self.refused_;
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  --self.allowed_;
  Block& block = self.block_for(self.type_of(needs.memoryTypeBits, required, preferred), needs);
  const uint64_t at = (block.used + needs.alignment - 1) / needs.alignment * needs.alignment;
  block.used = at + needs.size;
  const uint64_t number = ++self.given_;
  piece = {*block.memory, at, block.mapped == nullptr ? nullptr : block.mapped + at,
           reinterpret_cast<void*>(number)};
  self.live_[number] = {piece.memory, at};
  return VK_SUCCESS;
}

void CallersAllocator::free(void* user, const MemoryPiece& piece) {
  auto& self = *static_cast<CallersAllocator*>(user);
  const auto found = self.live_.find(reinterpret_cast<uint64_t>(piece.handle));
  if (found == self.live_.end() || found->second != std::pair{piece.memory, piece.offset}) {
    ++self.wrong_;
    return;
  }
  self.live_.erase(found);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_nothing(VkDevice, const VkMemoryAllocateInfo*,
                                                const VkAllocationCallbacks*, VkDeviceMemory*) {
  return VK_ERROR_UNKNOWN;
}

class GpuCallersMemory : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped()) return;
    callers_.emplace(device().info().name);
    allocator_.emplace(*callers_);
  }

  void TearDown() override {
    if (!callers_) return;
    for (const std::string& message : callers_->messages()) ADD_FAILURE() << message;
  }

  const CallersDevice& callers() const { return *callers_; }
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
  std::optional<CallersDevice> callers_;
  std::optional<CallersAllocator> allocator_;
};

TEST_F(GpuCallersMemory, IsAllThatBuffersTake) {
  {
    Device device = open_on_allocator();
    for (uint32_t seed = 0; seed < 4; ++seed) {
      expect_equal(device, tb::suite_stream(seed, 4), {.requests = 60, .seed = seed});
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
