#include "commands.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "kernel_accesses.hpp"

namespace hmlfc::gpu {
namespace {

Device::State& usable(Device::State& device) {
  if (!device.lost) return device;
  throw MachineError(FailureKind::kLost, "the device was lost before: open it again");
}

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

vk::PipelineStageFlags stages_of(unsigned work) {
  using Stage = vk::PipelineStageFlagBits;
  vk::PipelineStageFlags stages;
  if ((work & kCompute) != 0) stages |= Stage::eComputeShader;
  if ((work & kTransfer) != 0) stages |= Stage::eTransfer;
  if ((work & kIndirect) != 0) stages |= Stage::eDrawIndirect;
  if ((work & kHost) != 0) stages |= Stage::eHost;
  return stages;
}

using Access = vk::AccessFlagBits;

vk::AccessFlags writes_of(unsigned work) {
  vk::AccessFlags access;
  if ((work & kCompute) != 0) access |= Access::eShaderWrite;
  if ((work & kTransfer) != 0) access |= Access::eTransferWrite;
  return access;
}

vk::AccessFlags accesses_after(unsigned work) {
  vk::AccessFlags access = writes_of(work);
  if ((work & kCompute) != 0) access |= Access::eShaderRead;
  if ((work & kTransfer) != 0) access |= Access::eTransferRead;
  if ((work & kIndirect) != 0) access |= Access::eIndirectCommandRead;
  if ((work & kHost) != 0) access |= Access::eHostRead;
  return access;
}

// Bytes [begin, begin + bytes) of a buffer.
BufferAccess read(const Buffer& buffer, uint64_t begin, uint64_t bytes) {
  return {buffer.address(), "a buffer", true, false, begin, begin + bytes};
}

BufferAccess written(const Buffer& buffer, uint64_t begin, uint64_t bytes) {
  return {buffer.address(), "a buffer", false, true, begin, begin + bytes};
}

}  // namespace

Commands::Commands(Device::State& device, const FrameShape* frame)
    : device_(&device),
      frame_(frame),
      submission_(take_submission(usable(device), 2 * kMaxStages)) {
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
  barriers_ = 0;
  stages_.clear();
  timed_ = false;
  ++device_->counts.recorded;
  submission_->commands.begin(vk::CommandBufferBeginInfo());
  if (device_->timestamp_seconds != 0) {
    submission_->commands.resetQueryPool(*submission_->queries, 0, 2 * kMaxStages);
  }
  if (device_->hazards) checked_ = device_->hazards->begin();
}

void Commands::barrier(unsigned before, unsigned after) {
  const auto& fault = device_->barrier_fault;
  if (fault && fault->number == barriers_) {
    before &= ~fault->before;
    after &= ~fault->after;
  }
  ++barriers_;
  ++device_->counts.barriers;
  if (device_->hazards) device_->hazards->barrier(before, after);
  if (before == 0 || after == 0) return;
  const vk::MemoryBarrier memory(writes_of(before), accesses_after(after));
  submission_->commands.pipelineBarrier(stages_of(before), stages_of(after), {}, memory, {}, {});
}

template <class Dispatch>
void Commands::stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                     const Dispatch& dispatch) {
  if (stages_.size() == kMaxStages)
    throw MachineError(FailureKind::kInternal, "too many stages in one submission");
  submission_->commands.bindPipeline(vk::PipelineBindPoint::eCompute,
                                     device_->kernels->pipeline(kernel, variant));
  submission_->commands.pushConstants<Arguments>(device_->kernels->layout(),
                                                 vk::ShaderStageFlagBits::eCompute, 0, arguments);
  const auto begin = static_cast<uint32_t>(2 * stages_.size());
  write_time(begin);
  dispatch();
  stages_.push_back(kernel);
  write_time(begin + 1);
  if (!device_->hazards) return;
  device_->hazards->command(kernel);
  for (const BufferAccess& access : accesses_of(kernel, variant, arguments, frame_)) {
    device_->hazards->access(kCompute, access);
  }
}

void Commands::dispatch(const std::string& kernel, const Variant& variant,
                        const Arguments& arguments, uint64_t invocations) {
  if (invocations == 0) return;
  const auto workgroups = static_cast<uint32_t>(ceil_div(invocations, uint64_t{kWorkgroupSize}));
  const uint32_t columns = std::min(workgroups, device_->max_workgroups);
  dispatch_groups(kernel, variant, arguments, columns, ceil_div(workgroups, columns));
}

void Commands::dispatch_groups(const std::string& kernel, const Variant& variant,
                               const Arguments& arguments, uint32_t columns, uint32_t rows) {
  stage(kernel, variant, arguments, [&] { submission_->commands.dispatch(columns, rows, 1); });
}

void Commands::dispatch_counted(const std::string& kernel, const Variant& variant,
                                const Arguments& arguments, const Buffer& sizes, uint64_t offset) {
  stage(kernel, variant, arguments,
        [&] { submission_->commands.dispatchIndirect(sizes.handle(), offset); });
  if (!device_->hazards) return;
  device_->hazards->access(kIndirect, read(sizes, offset, 3 * sizeof(uint32_t)));
}

void Commands::fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word) {
  submission_->commands.fillBuffer(buffer.handle(), offset, bytes, word);
  if (!device_->hazards) return;
  device_->hazards->command("fill");
  device_->hazards->access(kTransfer, written(buffer, offset, bytes));
}

void Commands::copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
  if (bytes == 0) return;
  submission_->commands.copyBuffer(from.handle(), to.handle(),
                                   vk::BufferCopy(from_offset, to_offset, bytes));
  if (!device_->hazards) return;
  device_->hazards->command("copy");
  device_->hazards->access(kTransfer, read(from, from_offset, bytes));
  device_->hazards->access(kTransfer, written(to, to_offset, bytes));
}

void Commands::read_by_host(const Buffer& buffer) {
  if (!device_->hazards) return;
  device_->hazards->command("the host");
  device_->hazards->access(kHost, read(buffer, 0, buffer.size()));
}

void Commands::end() {
  submission_->commands.end();
  if (!device_->hazards) return;
  const std::string problem = device_->hazards->end();
  if (!problem.empty()) throw MachineError(FailureKind::kInternal, "barriers: " + problem);
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
  if (device_->hazards) device_->hazards->finished(checked_);
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

void Commands::write_time(uint32_t query) {
  if (device_->timestamp_seconds == 0) return;
  submission_->commands.writeTimestamp(vk::PipelineStageFlagBits::eComputeShader,
                                       *submission_->queries, query);
}

}  // namespace hmlfc::gpu
