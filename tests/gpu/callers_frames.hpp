// A program that draws recorded frames.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>

#include <hmlfc/gpu/recording.hpp>

#include "gpu/callers_memory.hpp"

namespace hmlfc::gpu {

/// A program that draws frames into its buffers, three under way: a timeline semaphore counts those
/// that are done.
class CallersFrames {
 public:
  CallersFrames(const CallersDevice& callers, uint64_t bytes)
      : callers_(&callers),
        pool_(callers.device(),
              {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, callers.family()}),
        commands_(callers.device(), {*pool_, vk::CommandBufferLevel::ePrimary, kUnderWay}),
        targets_{CallersBuffer(callers, bytes), CallersBuffer(callers, bytes),
                 CallersBuffer(callers, bytes)} {
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    done_.emplace(callers.device(), vk::SemaphoreCreateInfo({}, &timeline));
  }

  CallersFrames(const CallersFrames&) = delete;
  CallersFrames& operator=(const CallersFrames&) = delete;
  ~CallersFrames() { wait(number_); }

  static constexpr uint32_t kUnderWay = 3;

  /// Records and submits a frame; the number of frames so far, or a failure. Waits, with the
  /// program's own means, where three are under way.
  Outcome<uint64_t> draw(GpuRenderer& renderer, const FrameRecord& frame, int stop_level) {
    const size_t slot = number_ % kUnderWay;
    wait(number_ < kUnderWay ? 0 : number_ - kUnderWay + 1);
    const vk::raii::CommandBuffer& commands = commands_[slot];
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    const auto recorded = record(renderer, *commands, frame, stop_level,
                                 BufferTarget{targets_[slot].handle(), 0}, recordings_[slot]);
    if (!recorded) return tl::unexpected(recorded.error());
    const vk::MemoryBarrier host(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost,
                             {}, host, {}, {});
    commands.end();
    ++number_;
    submit(*commands);
    return number_;
  }

  /// The result and the texels of one of the last three frames, which it waits for.
  RecordedFrame result(uint64_t number) {
    wait(number);
    return recordings_[(number - 1) % kUnderWay].result();
  }
  std::span<const uint8_t> texels(uint64_t number) const {
    return targets_[(number - 1) % kUnderWay].bytes();
  }

  void wait(uint64_t number) const {
    const vk::SemaphoreWaitInfo all({}, **done_, number);
    if (callers_->device().waitSemaphores(all, UINT64_MAX) != vk::Result::eSuccess) std::abort();
  }

  void fill(uint8_t byte) {
    for (const CallersBuffer& target : targets_) std::ranges::fill(target.bytes(), byte);
  }

 private:
  void submit(vk::CommandBuffer commands) const {
    const vk::TimelineSemaphoreSubmitInfo values(0, nullptr, 1, &number_);
    const vk::Semaphore done = **done_;
    callers_->queue().submit(vk::SubmitInfo(0, nullptr, nullptr, 1, &commands, 1, &done, &values));
  }

  const CallersDevice* callers_;
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffers commands_;
  std::optional<vk::raii::Semaphore> done_;
  std::array<CallersBuffer, kUnderWay> targets_;
  std::array<FrameRecording, kUnderWay> recordings_;
  uint64_t number_ = 0;
};

}  // namespace hmlfc::gpu
