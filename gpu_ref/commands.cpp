#include "commands.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint32_t kMaxStages = 16;
constexpr uint64_t kWaitNanoseconds = uint64_t{600} * 1000 * 1000 * 1000;

vk::raii::CommandBuffer make_buffer(Device::State& device) {
  vk::raii::CommandBuffers buffers(
      *device.device,
      vk::CommandBufferAllocateInfo(**device.pool, vk::CommandBufferLevel::ePrimary, 1));
  return std::move(buffers.front());
}

}  // namespace

Commands::Commands(Device::State& device)
    : device_(&device),
      buffer_(make_buffer(device)),
      queries_(*device.device,
               vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2 * kMaxStages)) {
  buffer_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  if (device.timestamp_seconds != 0) buffer_.resetQueryPool(*queries_, 0, 2 * kMaxStages);
  barrier();
}

template <class Dispatch>
void Commands::stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                     const Dispatch& dispatch) {
  if (stages_.size() == kMaxStages) throw MachineError("too many stages in one submission");
  buffer_.bindPipeline(vk::PipelineBindPoint::eCompute,
                       device_->kernels->pipeline(kernel, variant));
  buffer_.pushConstants<Arguments>(device_->kernels->layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                   arguments);
  const auto begin = static_cast<uint32_t>(2 * stages_.size());
  write_time(begin);
  dispatch();
  stages_.push_back(kernel);
  barrier();
  write_time(begin + 1);
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
                                const Arguments& arguments, const Buffer& counts, uint64_t offset) {
  stage(kernel, variant, arguments, [&] { buffer_.dispatchIndirect(counts.handle(), offset); });
}

void Commands::fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word) {
  buffer_.fillBuffer(buffer.handle(), offset, bytes, word);
  barrier();
}

void Commands::copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
  if (bytes == 0) return;
  buffer_.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(from_offset, to_offset, bytes));
  barrier();
}

std::vector<StageTime> Commands::run() {
  buffer_.end();
  const vk::raii::Fence fence(*device_->device, vk::FenceCreateInfo());
  const vk::CommandBuffer handle = *buffer_;
  device_->queue->submit(vk::SubmitInfo({}, {}, handle), *fence);
  if (device_->device->waitForFences(*fence, VK_TRUE, kWaitNanoseconds) != vk::Result::eSuccess) {
    throw MachineError("the device has not answered for 10 minutes");
  }
  std::vector<StageTime> times;
  if (device_->timestamp_seconds == 0 || stages_.empty()) return times;
  const auto count = static_cast<uint32_t>(2 * stages_.size());
  const auto [result, ticks] = queries_.getResults<uint64_t>(
      0, count, count * sizeof(uint64_t), sizeof(uint64_t), vk::QueryResultFlagBits::e64);
  if (result != vk::Result::eSuccess) return times;
  for (size_t i = 0; i < stages_.size(); ++i) {
    const auto elapsed = static_cast<double>(ticks[2 * i + 1] - ticks[2 * i]);
    times.push_back({stages_[i], elapsed * device_->timestamp_seconds});
  }
  return times;
}

void Commands::barrier() {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const vk::MemoryBarrier memory(Access::eShaderWrite | Access::eTransferWrite | Access::eHostWrite,
                                 Access::eIndirectCommandRead | Access::eShaderRead |
                                     Access::eShaderWrite | Access::eTransferRead |
                                     Access::eTransferWrite | Access::eHostRead);
  buffer_.pipelineBarrier(
      Stage::eComputeShader | Stage::eTransfer | Stage::eHost,
      Stage::eDrawIndirect | Stage::eComputeShader | Stage::eTransfer | Stage::eHost, {}, memory,
      {}, {});
}

void Commands::write_time(uint32_t query) {
  if (device_->timestamp_seconds == 0) return;
  buffer_.writeTimestamp(vk::PipelineStageFlagBits::eComputeShader, *queries_, query);
}

}  // namespace hmlfc::gpu
