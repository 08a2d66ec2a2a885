#include "commands.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "kernel_accesses.hpp"

namespace hmlfc::gpu {
namespace {

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

Commands::Commands(Device::State& device, const FrameArguments* frame)
    : device_(&device), calls_(device.device->getDispatcher()), frame_(frame) {}

Commands::Commands(Device::State& device, vk::CommandBuffer commands) : Commands(device, nullptr) {
  begin(commands, {});
}

void Commands::begin(vk::CommandBuffer commands, vk::QueryPool queries) {
  commands_ = commands;
  queries_ = queries;
  stages_.clear();
  if (commands_) ++device_->counts.recorded;
  if (queries_) commands_.resetQueryPool(queries_, 0, 2 * kMaxStages, *calls_);
  if (device_->hazards) checked_ = device_->hazards->begin();
}

void Commands::finished() {
  if (device_->hazards) device_->hazards->finished(checked_);
}

void Commands::check() const {
  if (!device_->hazards) return;
  const std::string problem = device_->hazards->end();
  if (!problem.empty()) throw MachineError(FailureKind::kInternal, "barriers: " + problem);
}

void Commands::barrier(unsigned before, unsigned after) {
  if (device_->hazards) device_->hazards->barrier(before, after);
  if (!commands_ || before == 0 || after == 0) return;
  ++device_->counts.barriers;
  const vk::MemoryBarrier memory(writes_of(before), accesses_after(after));
  commands_.pipelineBarrier(stages_of(before), stages_of(after), {}, memory, {}, {}, *calls_);
}

template <class Dispatch>
void Commands::stage(const std::string& kernel, const Variant& variant, const Arguments& arguments,
                     const Dispatch& dispatch) {
  if (stages_.size() == kMaxStages)
    throw MachineError(FailureKind::kInternal, "too many stages in one submission");
  if (commands_) {
    commands_.bindPipeline(vk::PipelineBindPoint::eCompute,
                           device_->kernels->pipeline(kernel, variant), *calls_);
    commands_.pushConstants<Arguments>(device_->kernels->layout(),
                                       vk::ShaderStageFlagBits::eCompute, 0, arguments, *calls_);
    const auto begin = static_cast<uint32_t>(2 * stages_.size());
    write_time(begin);
    dispatch();
    write_time(begin + 1);
  }
  stages_.push_back(kernel);
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
  stage(kernel, variant, arguments, [&] { commands_.dispatch(columns, rows, 1, *calls_); });
}

void Commands::dispatch_counted(const std::string& kernel, const Variant& variant,
                                const Arguments& arguments, const Buffer& sizes, uint64_t offset) {
  stage(kernel, variant, arguments,
        [&] { commands_.dispatchIndirect(sizes.handle(), offset, *calls_); });
  if (!device_->hazards) return;
  device_->hazards->access(kIndirect, read(sizes, offset, 3 * sizeof(uint32_t)));
}

void Commands::fill(const Buffer& buffer, uint64_t offset, uint64_t bytes, uint32_t word) {
  if (commands_) commands_.fillBuffer(buffer.handle(), offset, bytes, word, *calls_);
  if (!device_->hazards) return;
  device_->hazards->command("fill");
  device_->hazards->access(kTransfer, written(buffer, offset, bytes));
}

void Commands::copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
  if (bytes == 0) return;
  if (commands_) {
    commands_.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(from_offset, to_offset, bytes),
                         *calls_);
  }
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

void Commands::write_time(uint32_t query) {
  if (!queries_) return;
  commands_.writeTimestamp(vk::PipelineStageFlagBits::eComputeShader, queries_, query, *calls_);
}

void Commands::copy_out(const Buffer& from, uint64_t bytes, vk::Buffer to, uint64_t offset) {
  if (bytes == 0) return;
  if (commands_) {
    commands_.copyBuffer(from.handle(), to, vk::BufferCopy(0, offset, bytes), *calls_);
  }
  if (!device_->hazards) return;
  device_->hazards->command("copy");
  device_->hazards->access(kTransfer, read(from, 0, bytes));
}

void Commands::copy_out(const Buffer& from, vk::Image to, vk::ImageLayout layout,
                        std::span<const vk::BufferImageCopy> regions) {
  if (regions.empty()) return;
  if (commands_) {
    const auto count = static_cast<uint32_t>(regions.size());
    commands_.copyBufferToImage(from.handle(), to, layout, count, regions.data(), *calls_);
  }
  if (!device_->hazards) return;
  device_->hazards->command("copy");
  device_->hazards->access(kTransfer, read(from, 0, from.size()));
}

}  // namespace hmlfc::gpu
