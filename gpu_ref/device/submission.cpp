#include "submission.hpp"

namespace hmlfc::gpu {
namespace {

// Idle handles of the device, or new ones for `queries` timestamps.
Device::State::SubmissionHandles take_handles(Device::State& device, uint32_t queries) {
  if (!device.idle.empty()) {
    auto submission = std::move(device.idle.back());
    device.idle.pop_back();
    return submission;
  }
  ++device.counts.made;
  vk::raii::CommandBuffers buffers(
      *device.device,
      vk::CommandBufferAllocateInfo(**device.pool, vk::CommandBufferLevel::ePrimary, 1));
  return {std::move(buffers.front()),
          vk::raii::QueryPool(*device.device,
                              vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, queries)),
          vk::raii::Fence(*device.device, vk::FenceCreateInfo())};
}

}  // namespace

Device::State& usable(Device::State& device) {
  if (!device.lost) return device;
  throw MachineError(FailureKind::kLost, "the device was lost before: open it again");
}

Submission::Submission(Device::State& device, const FrameArguments* frame)
    : Commands(device, frame), handles_(take_handles(usable(device), 2 * kMaxStages)) {
  begin();
}

Submission::~Submission() {
  try {
    wait();
    if (handles_) device_->idle.push_back(std::move(*handles_));
  } catch (const std::exception&) {
    // Abandoned by wait(), or of no more use.
  }
}

void Submission::restart() {
  usable(*device_);
  begin();
}

void Submission::begin() {
  timed_ = false;
  handles_->commands.begin(vk::CommandBufferBeginInfo());
  const bool timestamps = device_->timestamp_seconds != 0;
  Commands::begin(*handles_->commands, timestamps ? *handles_->queries : vk::QueryPool());
}

void Submission::end() {
  handles_->commands.end();
  check();
}

void Submission::submit() {
  usable(*device_);
  const vk::CommandBuffer handle = *handles_->commands;
  ++device_->counts.submitted;
  try {
    device_->device->resetFences(*handles_->fence);
    device_->queue->submit(vk::SubmitInfo({}, {}, handle), *handles_->fence);
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  pending_ = true;
}

bool Submission::done() {
  if (!pending_) return true;
  try {
    if (handles_->fence.getStatus() == vk::Result::eNotReady) return false;
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  pending_ = false;
  finished();
  return true;
}

void Submission::wait() {
  if (!pending_) return;
  ++device_->counts.waits;
  vk::Result result = vk::Result::eTimeout;
  try {
    result =
        device_->device->waitForFences(*handles_->fence, VK_TRUE, device_->timeout_nanoseconds);
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  if (result == vk::Result::eSuccess && done()) return;
  device_->lost = true;
  pending_ = false;
  device_->abandoned.push_back(std::move(*handles_));
  handles_.reset();
  throw MachineError(FailureKind::kTimeout,
                     "the device has not answered in " +
                         std::to_string(device_->timeout_nanoseconds / 1'000'000'000) +
                         " s: open it again");
}

void Submission::read_times() {
  if (device_->timestamp_seconds == 0 || stages_.empty()) return;
  const auto count = static_cast<uint32_t>(2 * stages_.size());
  const vk::Result result =
      (**device_->device)
          .getQueryPoolResults(*handles_->queries, 0, count, count * sizeof(uint64_t),
                               ticks_.data(), sizeof(uint64_t), vk::QueryResultFlagBits::e64,
                               *device_->device->getDispatcher());
  timed_ = result == vk::Result::eSuccess;
}

std::vector<StageTime> Submission::times() const {
  std::vector<StageTime> times;
  for (size_t i = 0; timed_ && i < stages_.size(); ++i) {
    const auto elapsed =
        static_cast<double>((ticks_[2 * i + 1] - ticks_[2 * i]) & device_->timestamp_mask);
    times.push_back({stages_[i], elapsed * device_->timestamp_seconds});
  }
  return times;
}

std::vector<StageTime> Submission::run() {
  end();
  submit();
  wait();
  read_times();
  return times();
}

}  // namespace hmlfc::gpu
