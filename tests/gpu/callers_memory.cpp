#include "gpu/callers_memory.hpp"

#include <stdexcept>
#include <utility>

namespace hmlfc::gpu {
namespace {

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

}  // namespace

vk::raii::DeviceMemory allocate(const CallersDevice& callers, const vk::MemoryRequirements& needs,
                                vk::MemoryPropertyFlags wanted) {
  const auto properties = callers.physical().getMemoryProperties();
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    const bool fits = (properties.memoryTypes[i].propertyFlags & wanted) == wanted;
    if (fits && (needs.memoryTypeBits >> i & 1u) != 0) {
      return {callers.device(), vk::MemoryAllocateInfo(needs.size, i)};
    }
  }
  throw std::runtime_error("no such memory");
}

CallersBuffer::CallersBuffer(const CallersDevice& callers, uint64_t bytes)
    : buffer_(callers.device(), vk::BufferCreateInfo({}, bytes,
                                                     vk::BufferUsageFlagBits::eTransferSrc |
                                                         vk::BufferUsageFlagBits::eTransferDst)),
      memory_(allocate(
          callers, buffer_.getMemoryRequirements(),
          vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent)) {
  buffer_.bindMemory(*memory_, 0);
  bytes_ = {static_cast<uint8_t*>(memory_.mapMemory(0, VK_WHOLE_SIZE)), static_cast<size_t>(bytes)};
}

CallersImage::CallersImage(const CallersDevice& callers, vk::Format format, uint32_t width,
                           uint32_t height, uint32_t layers)
    : extent_(width, height, 1),
      layers_(layers),
      image_(callers.device(),
             vk::ImageCreateInfo(
                 {}, vk::ImageType::e2D, format, extent_, 1, layers, vk::SampleCountFlagBits::e1,
                 vk::ImageTiling::eOptimal,
                 vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst)),
      memory_(allocate(callers, image_.getMemoryRequirements(), {})) {
  image_.bindMemory(*memory_, 0);
}

void CallersImage::clear(const vk::raii::CommandBuffer& commands) const {
  const vk::ImageMemoryBarrier begin({}, Access::eTransferWrite, Layout::eUndefined,
                                     Layout::eTransferDstOptimal, VK_QUEUE_FAMILY_IGNORED,
                                     VK_QUEUE_FAMILY_IGNORED, *image_, all());
  commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, begin);
  commands.clearColorImage(*image_, Layout::eTransferDstOptimal, vk::ClearColorValue(), all());
}

void CallersImage::read(const vk::raii::CommandBuffer& commands, vk::Buffer to) const {
  const vk::ImageMemoryBarrier end(Access::eTransferWrite, Access::eTransferRead,
                                   Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal,
                                   VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image_,
                                   all());
  commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, end);
  const vk::ImageSubresourceLayers layers(vk::ImageAspectFlagBits::eColor, 0, 0, layers_);
  commands.copyImageToBuffer(*image_, Layout::eTransferSrcOptimal, to,
                             vk::BufferImageCopy(0, 0, 0, layers, {}, extent_));
}

CallersCommands::CallersCommands(const CallersDevice& callers,
                                 const std::function<void(const vk::raii::CommandBuffer&)>& record)
    : callers_(&callers),
      pool_(callers.device(), vk::CommandPoolCreateInfo({}, callers.family())),
      commands_(std::move(vk::raii::CommandBuffers(callers.device(),
                                                   vk::CommandBufferAllocateInfo(
                                                       *pool_, vk::CommandBufferLevel::ePrimary, 1))
                              .front())) {
  commands_.begin(vk::CommandBufferBeginInfo());
  record(commands_);
  const vk::MemoryBarrier host(Access::eTransferWrite, Access::eHostRead);
  commands_.pipelineBarrier(Stage::eTransfer, Stage::eHost, {}, host, {}, {});
  commands_.end();
}

void CallersCommands::run() const {
  const vk::raii::Fence fence(callers_->device(), vk::FenceCreateInfo());
  const vk::CommandBuffer commands = *commands_;
  callers_->queue().submit(vk::SubmitInfo({}, {}, commands), *fence);
  if (callers_->device().waitForFences(*fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) {
    throw std::runtime_error("the commands did not end");
  }
}

}  // namespace hmlfc::gpu
