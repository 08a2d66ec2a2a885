#include "commands.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "kernel_accesses.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint32_t kMaxStages = 16;

Device::State& usable(Device::State& device) {
  if (!device.lost) return device;
  throw MachineError(FailureKind::kLost, "the device was lost before: open it again");
}

vk::raii::CommandBuffer make_buffer(Device::State& device) {
  vk::raii::CommandBuffers buffers(
      *device.device,
      vk::CommandBufferAllocateInfo(**device.pool, vk::CommandBufferLevel::ePrimary, 1));
  return std::move(buffers.front());
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
      buffer_(make_buffer(usable(device))),
      queries_(*device.device,
               vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2 * kMaxStages)) {
  buffer_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  if (device.timestamp_seconds != 0) buffer_.resetQueryPool(*queries_, 0, 2 * kMaxStages);
  if (device.hazards) device.hazards->begin();
  barrier(kCompute | kTransfer, kCompute | kTransfer);
}

void Commands::barrier(unsigned before, unsigned after) {
  const auto& fault = device_->barrier_fault;
  if (fault && fault->number == barriers_) {
    before &= ~fault->before;
    after &= ~fault->after;
  }
  ++barriers_;
  if (device_->hazards) device_->hazards->barrier(before, after);
  if (before == 0 || after == 0) return;
  const vk::MemoryBarrier memory(writes_of(before), accesses_after(after));
  buffer_.pipelineBarrier(stages_of(before), stages_of(after), {}, memory, {}, {});
}

template <class Dispatch>
void Commands::stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                     const Dispatch& dispatch) {
  if (stages_.size() == kMaxStages)
    throw MachineError(FailureKind::kInternal, "too many stages in one submission");
  buffer_.bindPipeline(vk::PipelineBindPoint::eCompute,
                       device_->kernels->pipeline(kernel, variant));
  buffer_.pushConstants<Arguments>(device_->kernels->layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                   arguments);
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
  stage(kernel, variant, arguments,
        [&] { buffer_.dispatch(columns, ceil_div(workgroups, columns), 1); });
}

void Commands::dispatch_counted(const std::string& kernel, const Variant& variant,
                                const Arguments& arguments, const Buffer& sizes, uint64_t offset) {
  stage(kernel, variant, arguments, [&] { buffer_.dispatchIndirect(sizes.handle(), offset); });
  if (!device_->hazards) return;
  device_->hazards->access(kIndirect, read(sizes, offset, 3 * sizeof(uint32_t)));
}

void Commands::write(const Buffer& buffer, std::span<const uint8_t> bytes) {
  buffer_.updateBuffer<uint8_t>(buffer.handle(), 0, bytes);
  if (!device_->hazards) return;
  device_->hazards->command("write");
  device_->hazards->access(kTransfer, written(buffer, 0, bytes.size()));
}

void Commands::fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word) {
  buffer_.fillBuffer(buffer.handle(), offset, bytes, word);
  if (!device_->hazards) return;
  device_->hazards->command("fill");
  device_->hazards->access(kTransfer, written(buffer, offset, bytes));
}

void Commands::copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
  if (bytes == 0) return;
  buffer_.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(from_offset, to_offset, bytes));
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

// Submits, and waits until the device is done.
void Commands::submit() {
  vk::raii::Fence fence(*device_->device, vk::FenceCreateInfo());
  const vk::CommandBuffer handle = *buffer_;
  bool done = false;
  try {
    device_->queue->submit(vk::SubmitInfo({}, {}, handle), *fence);
    done = device_->device->waitForFences(*fence, VK_TRUE, device_->timeout_nanoseconds) ==
           vk::Result::eSuccess;
  } catch (const vk::DeviceLostError&) {
    device_->lost = true;
    throw;
  }
  if (done) return;
  device_->lost = true;
  device_->abandoned.push_back({std::move(buffer_), std::move(queries_), std::move(fence)});
  throw MachineError(FailureKind::kTimeout,
                     "the device has not answered in " +
                         std::to_string(device_->timeout_nanoseconds / 1'000'000'000) +
                         " s: open it again");
}

std::vector<StageTime> Commands::run() {
  buffer_.end();
  if (device_->hazards) {
    const std::string problem = device_->hazards->end();
    if (!problem.empty()) throw MachineError(FailureKind::kInternal, "barriers: " + problem);
  }
  submit();
  std::vector<StageTime> times;
  if (device_->timestamp_seconds == 0 || stages_.empty()) return times;
  const auto count = static_cast<uint32_t>(2 * stages_.size());
  const auto [result, ticks] = queries_.getResults<uint64_t>(
      0, count, count * sizeof(uint64_t), sizeof(uint64_t), vk::QueryResultFlagBits::e64);
  if (result != vk::Result::eSuccess) return times;
  for (size_t i = 0; i < stages_.size(); ++i) {
    const auto elapsed =
        static_cast<double>((ticks[2 * i + 1] - ticks[2 * i]) & device_->timestamp_mask);
    times.push_back({stages_[i], elapsed * device_->timestamp_seconds});
  }
  return times;
}

void Commands::write_time(uint32_t query) {
  if (device_->timestamp_seconds == 0) return;
  buffer_.writeTimestamp(vk::PipelineStageFlagBits::eComputeShader, *queries_, query);
}

}  // namespace hmlfc::gpu
