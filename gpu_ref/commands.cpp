#include "commands.hpp"

namespace hmlfc::gpu {
namespace {

// An idle submission of the device, or a new one for `queries` timestamps.
Device::State::Submission take_submission(Device::State& device, uint32_t queries) {
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

Commands::Commands(Device::State& device, const FrameShape* frame)
    : Recorder(device, frame), submission_(take_submission(usable(device), 2 * kMaxStages)) {
  begin();
}

Commands::~Commands() {
  try {
    wait();
    if (submission_) device_->idle.push_back(std::move(*submission_));
  } catch (const std::exception&) {
    // Abandoned by wait(), or of no more use.
  }
}

void Commands::restart() {
  usable(*device_);
  begin();
}

void Commands::begin() {
  timed_ = false;
  submission_->commands.begin(vk::CommandBufferBeginInfo());
  const bool timestamps = device_->timestamp_seconds != 0;
  Recorder::begin(*submission_->commands, timestamps ? *submission_->queries : vk::QueryPool());
}

void Commands::end() {
  submission_->commands.end();
  check();
}

void Commands::submit() {
  usable(*device_);
  const vk::CommandBuffer handle = *submission_->commands;
  ++device_->counts.submitted;
  try {
    device_->device->resetFences(*submission_->fence);
    device_->queue->submit(vk::SubmitInfo({}, {}, handle), *submission_->fence);
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  pending_ = true;
}

bool Commands::done() {
  if (!pending_) return true;
  try {
    if (submission_->fence.getStatus() == vk::Result::eNotReady) return false;
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  pending_ = false;
  finished();
  return true;
}

void Commands::wait() {
  if (!pending_) return;
  ++device_->counts.waits;
  vk::Result result = vk::Result::eTimeout;
  try {
    result =
        device_->device->waitForFences(*submission_->fence, VK_TRUE, device_->timeout_nanoseconds);
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  if (result == vk::Result::eSuccess && done()) return;
  device_->lost = true;
  pending_ = false;
  device_->abandoned.push_back(std::move(*submission_));
  submission_.reset();
  throw MachineError(FailureKind::kTimeout,
                     "the device has not answered in " +
                         std::to_string(device_->timeout_nanoseconds / 1'000'000'000) +
                         " s: open it again");
}

void Commands::read_times() {
  if (device_->timestamp_seconds == 0 || stages_.empty()) return;
  const auto count = static_cast<uint32_t>(2 * stages_.size());
  const vk::Result result =
      (**device_->device)
          .getQueryPoolResults(*submission_->queries, 0, count, count * sizeof(uint64_t),
                               ticks_.data(), sizeof(uint64_t), vk::QueryResultFlagBits::e64,
                               *device_->device->getDispatcher());
  timed_ = result == vk::Result::eSuccess;
}

std::vector<StageTime> Commands::times() const {
  std::vector<StageTime> times;
  for (size_t i = 0; timed_ && i < stages_.size(); ++i) {
    const auto elapsed =
        static_cast<double>((ticks_[2 * i + 1] - ticks_[2 * i]) & device_->timestamp_mask);
    times.push_back({stages_[i], elapsed * device_->timestamp_seconds});
  }
  return times;
}

std::vector<StageTime> Commands::run() {
  end();
  submit();
  wait();
  read_times();
  return times();
}

}  // namespace hmlfc::gpu
