// The decoder on a device that the caller has opened.
#include <functional>
#include <string>
#include <utility>

#include "decoder/open_stream.hpp"
#include "gpu/callers_device.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuCallersDevice : public GpuTest {
 protected:
  static CallersDevice make(const CallersOptions& options = {}) {
    return CallersDevice(device().info().name, options);
  }

  /// The message with which `handles` are refused.
  static std::string refusal(const VulkanDevice& handles, DeviceOptions options = {}) {
    options.cache_folder = "";
    const auto opened = open_device(handles, options);
    if (opened) return "";
    EXPECT_EQ(opened.error().kind, FailureKind::kUnusable);
    return opened.error().message;
  }
};

void expect_named(const std::string& message, const std::string& what) {
  EXPECT_NE(message.find(what), std::string::npos) << message;
}

// With either record of the feature; the caller's device is as before when the decoder is gone.
TEST_F(GpuCallersDevice, DecodesAndStaysTheCallers) {
  for (const bool features12 : {false, true}) {
    const CallersDevice callers = make({.features12 = features12});
    {
      DeviceOptions options;
      options.cache_folder = "";
      options.check_barriers = true;
      auto device = open_device(callers.handles(), options);
      ASSERT_TRUE(device) << device.error().message;
      EXPECT_EQ(device->info().name, GpuTest::device().info().name);
      EXPECT_EQ(vulkan_device(*device).queue, callers.handles().queue);
      for (uint32_t seed = 0; seed < 3; ++seed) {
        expect_equal(*device, tb::suite_stream(seed, 2u << seed), {.requests = 60, .seed = seed});
      }
    }
    const vk::raii::Fence fence(callers.device(), vk::FenceCreateInfo());
    callers.queue().submit({}, *fence);
    EXPECT_EQ(callers.device().waitForFences(*fence, VK_TRUE, UINT64_MAX), vk::Result::eSuccess);
    for (const std::string& message : callers.messages()) ADD_FAILURE() << message;
  }
}

TEST_F(GpuCallersDevice, IsRefusedWithTheReason) {
  const CallersDevice callers = make();
  const VulkanDevice good = callers.handles();
  const std::pair<const char*, std::function<void(VulkanDevice&)>> faults[] = {
      {"instance is null", [](VulkanDevice& h) { h.instance = nullptr; }},
      {"physical is null", [](VulkanDevice& h) { h.physical = nullptr; }},
      {"device is null", [](VulkanDevice& h) { h.device = nullptr; }},
      {"created is null", [](VulkanDevice& h) { h.created = nullptr; }},
      {"queue is null", [](VulkanDevice& h) { h.queue = nullptr; }},
      {"without queues of queue_family 7", [](VulkanDevice& h) { h.queue_family = 7; }},
      {"queue is none of queue_family",
       [](VulkanDevice& h) { h.queue = reinterpret_cast<VkQueue>(&h); }},
  };
  for (const auto& [message, plant] : faults) {
    VulkanDevice handles = good;
    plant(handles);
    expect_named(refusal(handles), message);
  }
  EXPECT_EQ(refusal(good), "");
}

TEST_F(GpuCallersDevice, IsRefusedWithoutTheFeature) {
  for (const bool features12 : {false, true}) {
    const CallersDevice callers = make({.addresses = false, .features12 = features12});
    expect_named(refusal(callers.handles()), "without bufferDeviceAddress");
  }
}

// A driver may have the functions of later versions all the same; then the device can be used.
TEST_F(GpuCallersDevice, IsRefusedBelowVulkan12) {
  for (const uint32_t version : {VK_API_VERSION_1_0, VK_API_VERSION_1_1}) {
    const CallersDevice callers = make({.version = version});
    const std::string message = refusal(callers.handles());
    if (message.empty()) {
      EXPECT_NE(callers.device().getDispatcher()->vkGetBufferDeviceAddress, nullptr);
    } else {
      expect_named(message, "below 1.2");
    }
  }
}

TEST_F(GpuCallersDevice, IsNotMadeByOptions) {
  const CallersDevice callers = make();
  const std::pair<const char*, std::function<void(DeviceOptions&)>> set[] = {
      {"DeviceOptions::device", [](DeviceOptions& o) { o.device = "0"; }},
      {"DeviceOptions::validation", [](DeviceOptions& o) { o.validation = true; }},
      {"DeviceOptions::guard_pages", [](DeviceOptions& o) { o.guard_pages = true; }},
  };
  for (const auto& [name, plant] : set) {
    DeviceOptions options;
    plant(options);
    expect_named(refusal(callers.handles(), options), name);
  }
}

}  // namespace
}  // namespace hmlfc::gpu
