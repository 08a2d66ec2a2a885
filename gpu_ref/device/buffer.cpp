#include "buffer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "submission.hpp"

namespace hmlfc::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// The wanted properties of memory types, the best first; the last is required.
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
  throw MachineError(FailureKind::kUnusable, "the device has no memory that its host can reach");
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

BorrowedMemory::BorrowedMemory(const MemoryCallbacks& callbacks, const VkMemoryRequirements& needs,
                               vk::MemoryPropertyFlags required, vk::MemoryPropertyFlags preferred)
    : callbacks_(callbacks) {
  const VkResult result =
      callbacks_.allocate(callbacks_.user, needs, static_cast<VkMemoryPropertyFlags>(required),
                          static_cast<VkMemoryPropertyFlags>(preferred), piece_);
  if (result != VK_SUCCESS) throw vk::OutOfDeviceMemoryError("MemoryCallbacks::allocate");
}

BorrowedMemory::BorrowedMemory(BorrowedMemory&& other) noexcept
    : callbacks_(std::exchange(other.callbacks_, {})), piece_(other.piece_) {}

BorrowedMemory::~BorrowedMemory() {
  if (callbacks_.free != nullptr) callbacks_.free(callbacks_.user, piece_);
}

Buffer::Buffer(Device::State& device, uint64_t bytes, Memory memory)
    : device_(&device),
      size_(4 * ceil_div(std::max<uint64_t>(bytes, 1), uint64_t{4})),
      memory_(nullptr),
      buffer_(*device.device, buffer_info(size_, device.guard_pages ? &kExternal : nullptr)) {
  const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
  if (device.guard_pages) {
    allocate_guarded(device, needs);
  } else {
    allocate(device, needs, memory);
  }
  address_ = device.device->getBufferAddress(vk::BufferDeviceAddressInfo(*buffer_));
  if (device.hazards) device.hazards->add_buffer(address_);
}

void Buffer::allocate(Device::State& device, const vk::MemoryRequirements& needs, Memory memory) {
  if (device.memory.allocate != nullptr) {
    const auto [preferred, required] = wanted_properties(memory);
    borrowed_.emplace(device.memory, needs, required, preferred);
    const MemoryPiece& piece = borrowed_->piece();
    buffer_.bindMemory(piece.memory, piece.offset);
    if (memory != Memory::kDevice) mapped_ = static_cast<uint8_t*>(piece.mapped);
    return;
  }
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

void upload(Device::State& device, std::span<const uint8_t> bytes, const Buffer& to) {
  const Buffer staging(device, bytes.size(), Memory::kUpload);
  std::ranges::copy(bytes, staging.bytes().begin());
  Submission commands(device);
  commands.copy(staging, 0, to, 0, bytes.size());
  commands.run();
}

ChunkedWords::ChunkedWords(Device::State& device, uint64_t words)
    : bytes_(4 * std::max<uint64_t>(words, 1)),
      chunk_log2_(static_cast<uint32_t>(std::bit_width(device.chunk_bytes / 4)) - 1) {
  const uint64_t chunk_bytes = uint64_t{4} << chunk_log2_;
  for (uint64_t at = 0; at < bytes_; at += chunk_bytes) {
    chunks_.emplace_back(device, std::min(chunk_bytes, bytes_ - at), Memory::kDevice);
  }
  std::vector<uint64_t> addresses(chunks_.size());
  std::ranges::transform(chunks_, addresses.begin(), [](const Buffer& b) { return b.address(); });
  table_.emplace(device, addresses.size() * sizeof(uint64_t), Memory::kDevice);
  hmlfc::gpu::upload(device, bytes_of(addresses), *table_);
  if (!device.hazards) return;
  for (size_t i = 0; i < addresses.size(); ++i) {
    device.hazards->join(addresses[i], table_->address(), i * chunk_bytes);
  }
}

void ChunkedWords::upload(Device::State& device, uint64_t at, std::span<const uint8_t> bytes) {
  const uint64_t chunk_bytes = uint64_t{4} << chunk_log2_;
  const uint64_t most = std::min<uint64_t>(device.upload_bytes, bytes.size());
  const Buffer staging(device, most, Memory::kUpload);
  while (!bytes.empty()) {
    const auto part = static_cast<size_t>(std::min<uint64_t>(bytes.size(), most));
    std::memcpy(staging.bytes().data(), bytes.data(), part);
    Submission commands(device);
    for (uint64_t done = 0; done < part;) {
      const uint64_t in_chunk = (at + done) % chunk_bytes;
      // A copy of whole words: the staging buffer and the chunks are padded to them.
      const uint64_t run = std::min(chunk_bytes - in_chunk, part - done);
      commands.copy(staging, done, chunks_[static_cast<size_t>((at + done) / chunk_bytes)],
                    in_chunk, run);
      done += run;
    }
    commands.run();
    at += part;
    bytes = bytes.subspan(part);
  }
}

}  // namespace hmlfc::gpu
