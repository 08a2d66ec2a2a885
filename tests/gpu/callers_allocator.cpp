#include "gpu/callers_allocator.hpp"

#include <algorithm>

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kBlockBytes = uint64_t{8} << 20;

}  // namespace

MemoryCallbacks CallersAllocator::callbacks() { return {this, &allocate, &free}; }

uint32_t CallersAllocator::type_of(uint32_t allowed, VkMemoryPropertyFlags required,
                                   VkMemoryPropertyFlags preferred) const {
  const auto properties = callers_->physical().getMemoryProperties();
  for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
      const auto has = static_cast<VkMemoryPropertyFlags>(properties.memoryTypes[i].propertyFlags);
      if ((allowed >> i & 1u) != 0 && (has & wanted) == wanted) return i;
    }
  }
  throw std::runtime_error("no such memory");
}

CallersAllocator::Block& CallersAllocator::block_for(uint32_t type,
                                                     const VkMemoryRequirements& needs) {
  auto& blocks = blocks_[type];
  if (blocks.empty() || blocks.back().used + needs.alignment + needs.size > blocks.back().bytes) {
    const uint64_t bytes = std::max(kBlockBytes, needs.alignment + needs.size);
    const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
    vk::raii::DeviceMemory memory(callers_->device(), vk::MemoryAllocateInfo(bytes, type, &flags));
    const auto properties = callers_->physical().getMemoryProperties().memoryTypes[type];
    const bool visible = bool(properties.propertyFlags & vk::MemoryPropertyFlagBits::eHostVisible);
    auto* mapped = visible ? static_cast<uint8_t*>(memory.mapMemory(0, VK_WHOLE_SIZE)) : nullptr;
    // No piece begins where its memory does.
    blocks.push_back({std::move(memory), mapped, 1, bytes});
  }
  return blocks.back();
}

VkResult CallersAllocator::allocate(void* user, const VkMemoryRequirements& needs,
                                    VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                                    MemoryPiece& piece) {
  auto& self = *static_cast<CallersAllocator*>(user);
  if (self.allowed_ == 0) {
    ++self.refused_;
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  --self.allowed_;
  Block& block = self.block_for(self.type_of(needs.memoryTypeBits, required, preferred), needs);
  const uint64_t at = (block.used + needs.alignment - 1) / needs.alignment * needs.alignment;
  block.used = at + needs.size;
  const uint64_t number = ++self.given_;
  piece = {*block.memory, at, block.mapped == nullptr ? nullptr : block.mapped + at,
           reinterpret_cast<void*>(number)};
  self.live_[number] = {piece.memory, at};
  return VK_SUCCESS;
}

void CallersAllocator::free(void* user, const MemoryPiece& piece) {
  auto& self = *static_cast<CallersAllocator*>(user);
  const auto found = self.live_.find(reinterpret_cast<uint64_t>(piece.handle));
  if (found == self.live_.end() || found->second != std::pair{piece.memory, piece.offset}) {
    ++self.wrong_;
    return;
  }
  self.live_.erase(found);
}

}  // namespace hmlfc::gpu
