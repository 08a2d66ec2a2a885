// Device memory that a caller gives out piece by piece.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gpu/callers_device.hpp"

namespace hmlfc::gpu {

/// Pieces one behind the other in blocks of memory. Every piece must come back.
class CallersAllocator {
 public:
  explicit CallersAllocator(const CallersDevice& callers) : callers_(&callers) {}
  CallersAllocator(const CallersAllocator&) = delete;
  CallersAllocator& operator=(const CallersAllocator&) = delete;

  MemoryCallbacks callbacks();

  /// The next `pieces` are given, and none after them until this is called again.
  void allow(uint64_t pieces) { allowed_ = pieces; }

  uint64_t given() const { return given_; }
  uint64_t refused() const { return refused_; }
  uint64_t live() const { return live_.size(); }

  /// Pieces that came back and were not given, or with another content than given.
  uint64_t wrong() const { return wrong_; }

 private:
  struct Block {
    vk::raii::DeviceMemory memory;
    uint8_t* mapped;
    uint64_t used;
    uint64_t bytes;
  };

  static VkResult allocate(void* user, const VkMemoryRequirements& needs,
                           VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                           MemoryPiece& piece);
  static void free(void* user, const MemoryPiece& piece);

  uint32_t type_of(uint32_t allowed, VkMemoryPropertyFlags required,
                   VkMemoryPropertyFlags preferred) const;
  Block& block_for(uint32_t type, const VkMemoryRequirements& needs);

  const CallersDevice* callers_;
  std::map<uint32_t, std::vector<Block>> blocks_;  // by memory type
  std::map<uint64_t, std::pair<VkDeviceMemory, uint64_t>> live_;
  uint64_t allowed_ = UINT64_MAX;
  uint64_t given_ = 0, refused_ = 0, wrong_ = 0;
};

}  // namespace hmlfc::gpu
