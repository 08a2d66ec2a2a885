#include "buffer.hpp"

#include <algorithm>
#include <array>

#include "arithmetic/rounding.hpp"

namespace hmlfc::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// The wanted properties of memory types, the best first; the last is what must be.
std::array<vk::MemoryPropertyFlags, 2> wanted_properties(Memory memory) {
  const vk::MemoryPropertyFlags host = Property::eHostVisible | Property::eHostCoherent;
  switch (memory) {
    case Memory::kDevice:
      return {Property::eDeviceLocal, vk::MemoryPropertyFlags{}};
    case Memory::kUpload:
      return {host, host};
    case Memory::kReadback:
      return {host | Property::eHostCached, host};
  }
  return {};
}

uint32_t memory_type(Device::State& device, uint32_t allowed, Memory memory) {
  const auto properties = device.physical->getMemoryProperties();
  for (const vk::MemoryPropertyFlags wanted : wanted_properties(memory)) {
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
      const bool fits = (properties.memoryTypes[i].propertyFlags & wanted) == wanted;
      if ((allowed >> i & 1u) != 0 && fits) return i;
    }
  }
  throw MachineError("the device has no memory that its host can reach");
}

vk::BufferCreateInfo buffer_info(uint64_t size,
                                 const vk::ExternalMemoryBufferCreateInfo* external) {
  return vk::BufferCreateInfo({}, size,
                              vk::BufferUsageFlagBits::eStorageBuffer |
                                  vk::BufferUsageFlagBits::eShaderDeviceAddress |
                                  vk::BufferUsageFlagBits::eIndirectBuffer |
                                  vk::BufferUsageFlagBits::eTransferSrc |
                                  vk::BufferUsageFlagBits::eTransferDst)
      .setPNext(external);
}

constexpr auto kHostPages = vk::ExternalMemoryHandleTypeFlagBits::eHostAllocationEXT;
const vk::ExternalMemoryBufferCreateInfo kExternal(kHostPages);

}  // namespace

Buffer::Buffer(Device::State& device, uint64_t bytes, Memory memory)
    : size_(4 * ceil_div(std::max<uint64_t>(bytes, 1), uint64_t{4})),
      memory_(nullptr),
      buffer_(*device.device, buffer_info(size_, device.guard_pages ? &kExternal : nullptr)) {
  const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
  if (device.guard_pages) {
    allocate_guarded(device, needs);
  } else {
    allocate(device, needs, memory);
  }
  address_ = device.device->getBufferAddress(vk::BufferDeviceAddressInfo(*buffer_));
}

void Buffer::allocate(Device::State& device, const vk::MemoryRequirements& needs, Memory memory) {
  const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
  memory_ = vk::raii::DeviceMemory(
      *device.device, vk::MemoryAllocateInfo(
                          needs.size, memory_type(device, needs.memoryTypeBits, memory), &flags));
  buffer_.bindMemory(*memory_, 0);
  if (memory != Memory::kDevice) {
    mapped_ = static_cast<uint8_t*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
  }
}

// The buffer ends where its alignment allows, at most that many bytes before the guard.
void Buffer::allocate_guarded(Device::State& device, const vk::MemoryRequirements& needs) {
  pages_.emplace(static_cast<size_t>(needs.size));
  const auto host = device.device->getMemoryHostPointerPropertiesEXT(kHostPages, pages_->data());
  const uint32_t type =
      memory_type(device, needs.memoryTypeBits & host.memoryTypeBits, Memory::kUpload);
  const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
  const vk::ImportMemoryHostPointerInfoEXT import(kHostPages, pages_->data(), &flags);
  memory_ =
      vk::raii::DeviceMemory(*device.device, vk::MemoryAllocateInfo(pages_->size(), type, &import));
  const uint64_t slack = pages_->size() - size_;
  const uint64_t offset = slack - slack % needs.alignment;
  buffer_.bindMemory(*memory_, offset);
  mapped_ = static_cast<uint8_t*>(pages_->data()) + offset;
}

}  // namespace hmlfc::gpu
