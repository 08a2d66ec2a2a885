#include <memory>
#include <vector>

#include <hmlfc/gpu/recording.hpp>

#include "buffer.hpp"
#include "gpu/cpu_time.hpp"
#include "gpu/host_cost.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kMostTexelBytes = 8;

// A program's frame under way: what it draws with.
struct RecordedSlot {
  RecordedSlot(Device::State& device, uint64_t bytes)
      : target(device, bytes, Memory::kDevice),
        pool(*device.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.family}),
        commands(*device.device, {*pool, vk::CommandBufferLevel::ePrimary, 1}),
        done(*device.device, vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled)) {}

  Buffer target;
  FrameRecording recording;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffers commands;
  vk::raii::Fence done;
};

Outcome<void> draw(GpuRenderer& renderer, Device::State& device, RecordedSlot& slot,
                   const FrameRecord& frame, double& seconds) {
  const vk::CommandBuffer commands = *slot.commands.front();
  const BufferTarget target{slot.target.handle(), 0};
  slot.commands.front().begin(vk::CommandBufferBeginInfo());
  auto recorded =
      timed([&] { return record(renderer, commands, frame, 0, target, slot.recording); }, seconds);
  slot.commands.front().end();
  device.queue->submit(vk::SubmitInfo({}, {}, commands), *slot.done);
  return recorded;
}

// The CPU time of `frames` recorded frames; waits for all of them.
Outcome<double> draw(GpuRenderer& renderer, Device::State& device,
                     std::span<const std::unique_ptr<RecordedSlot>> slots,
                     std::span<const FrameRecord> records, uint64_t frames) {
  double seconds = 0;
  const auto wait = [&](const RecordedSlot& slot) {
    return device.device->waitForFences(*slot.done, VK_TRUE, UINT64_MAX);
  };
  for (uint64_t i = 0; i < frames; ++i) {
    RecordedSlot& slot = *slots[i % slots.size()];
    if (wait(slot) != vk::Result::eSuccess) break;
    device.device->resetFences(*slot.done);
    const auto drawn = draw(renderer, device, slot, records[i % records.size()], seconds);
    if (!drawn) return tl::unexpected(drawn.error());
  }
  for (const auto& slot : slots) {
    if (wait(*slot) != vk::Result::eSuccess || slot->recording.result().status != ErrorCode::kOk) {
      return tl::unexpected(Failure{FailureKind::kInternal, "a recorded frame was not drawn"});
    }
  }
  return seconds;
}

}  // namespace

Outcome<HostCost> measure_recording(GpuRenderer& renderer, Device& device,
                                    std::span<const FrameRecord> records, uint64_t frames) {
  Device::State& state = device.state();
  const auto pixels = static_cast<uint64_t>(records.front().frame_width) *
                      static_cast<uint64_t>(records.front().frame_height);
  std::vector<std::unique_ptr<RecordedSlot>> slots(GpuRenderer::most_under_way());
  for (auto& slot : slots) slot = std::make_unique<RecordedSlot>(state, kMostTexelBytes * pixels);
  const auto first = draw(renderer, state, slots, records, slots.size() + records.size());
  if (!first) return tl::unexpected(first.error());
  const SubmissionCounts before = device.counts();
  const auto seconds = draw(renderer, state, slots, records, frames);
  if (!seconds) return tl::unexpected(seconds.error());
  return HostCost{frames, *seconds, counted_since(before, device)};
}

}  // namespace hmlfc::gpu
