// What frames cost the host while the device draws others.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <hmlfc/gpu/recording.hpp>

#include "common/measuring.hpp"
#include "device/buffer.hpp"
#include "gpu/gpu_speed.hpp"

namespace hmlfc::bench {
namespace {

using namespace gpu;

constexpr uint64_t kMostTexelBytes = 8;

// CPU time of the calling thread.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Calls `call`, which gives an Outcome, and adds its CPU time.
template <class Call>
void timed(const Call& call, double& seconds) {
  const double begin = thread_seconds();
  auto outcome = call();
  seconds += thread_seconds() - begin;
  value_of(std::move(outcome));
}

// The CPU time of `frames` frames.
double draw(GpuRenderer& renderer, std::span<const FrameRecord> records, uint64_t frames) {
  double seconds = 0;
  GpuFrame frame;
  for (uint64_t begun = 0, finished = 0; finished < frames;) {
    if (begun < frames && renderer.under_way() < GpuRenderer::most_under_way()) {
      const FrameRecord& record = records[begun++ % records.size()];
      timed([&] { return renderer.begin(record, 0, FrameOutput::kDevice); }, seconds);
    } else if (!value_of(renderer.ready())) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    } else {
      timed([&] { return renderer.finish(frame); }, seconds);
      ++finished;
    }
  }
  return seconds;
}

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

// The CPU time of `frames` recorded frames; waits for all of them.
double draw_recorded(GpuRenderer& renderer, Device::State& device,
                     std::span<const std::unique_ptr<RecordedSlot>> slots,
                     std::span<const FrameRecord> records, uint64_t frames) {
  double seconds = 0;
  const auto wait = [&](const RecordedSlot& slot) {
    if (device.device->waitForFences(*slot.done, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) {
      throw std::runtime_error("a recorded frame does not end");
    }
  };
  for (uint64_t i = 0; i < frames; ++i) {
    RecordedSlot& slot = *slots[i % slots.size()];
    wait(slot);
    device.device->resetFences(*slot.done);
    const vk::CommandBuffer commands = *slot.commands.front();
    const BufferTarget target{slot.target.handle(), 0};
    const FrameRecord& frame = records[i % records.size()];
    slot.commands.front().begin(vk::CommandBufferBeginInfo());
    timed([&] { return record(renderer, commands, frame, 0, target, slot.recording); }, seconds);
    slot.commands.front().end();
    device.queue->submit(vk::SubmitInfo({}, {}, commands), *slot.done);
  }
  for (const auto& slot : slots) {
    wait(*slot);
    if (slot->recording.result().status != ErrorCode::kOk) {
      throw std::runtime_error("a recorded frame was not drawn");
    }
  }
  return seconds;
}

}  // namespace

double host_microseconds(GpuRenderer& renderer, std::span<const FrameRecord> records) {
  const auto frames = static_cast<uint64_t>(records.size());
  draw(renderer, records, std::max<uint64_t>(frames, GpuRenderer::most_under_way()));
  return 1e6 * draw(renderer, records, frames) / static_cast<double>(frames);
}

double recording_microseconds(GpuRenderer& renderer, Device& device,
                              std::span<const FrameRecord> records) {
  Device::State& state = device.state();
  const auto pixels = static_cast<uint64_t>(records.front().frame_width) *
                      static_cast<uint64_t>(records.front().frame_height);
  std::vector<std::unique_ptr<RecordedSlot>> slots(GpuRenderer::most_under_way());
  for (auto& slot : slots) slot = std::make_unique<RecordedSlot>(state, kMostTexelBytes * pixels);
  draw_recorded(renderer, state, slots, records, slots.size() + records.size());
  return 1e6 * draw_recorded(renderer, state, slots, records, records.size()) /
         static_cast<double>(records.size());
}

}  // namespace hmlfc::bench
