// What tests on a device of the caller share.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/gpu/vulkan_device.hpp>
#include <hmlfc/renderer.hpp>

#include "gpu/callers_device.hpp"
#include "gpu/gpu_test.hpp"

namespace hmlfc::gpu {

/// A stream of the encoder, or one with random fields: of any depth, in both chroma formats.
std::vector<uint8_t> stream_of(uint32_t seed);

/// The samples of texels, R, G, B and A in turn.
std::vector<uint16_t> samples_of(std::span<const uint8_t> texels, const StreamHeader& header);

/// The texels of a frame of the golden renderer, which gave `drawn` and `frame` for `record`: R, G,
/// B and A in turn; all 0 for an error.
std::vector<uint16_t> texels_of(const Result<void>& drawn, const Frame& frame,
                                const FrameRecord& record, const StreamHeader& header);

/// Records commands on a device of the library's own, and runs them.
void run_alone(Device& device, const std::function<void(VkCommandBuffer)>& record);

/// Without a message of the validation layer.
class CallersTest : public GpuTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Opens the caller's device; a failure of the test where that is not possible.
  std::optional<Device> open_shared(DeviceOptions options);

  const CallersDevice& callers() const { return *callers_; }

  /// The caller's device, opened with the check of barriers.
  Device& shared() { return *shared_; }

 private:
  std::optional<CallersDevice> callers_;
  std::optional<Device> shared_;
};

}  // namespace hmlfc::gpu
