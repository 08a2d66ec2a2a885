// Where recorded texels go: a buffer or an image of the caller.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <hmlfc/gpu/recording.hpp>

#include "device/commands.hpp"

namespace hmlfc::gpu {

class TexelTarget {
 public:
  /// Texels without gaps.
  explicit TexelTarget(const BufferTarget& target) : buffer_(target) {}

  /// Rectangles of `extents` texels of `texel_bytes` bytes, each to its place. Throws MachineError,
  /// kLimit, where `target` does not have as many places; `whose` names them in the message.
  TexelTarget(const ImageTarget& target, std::span<const VkExtent2D> extents, uint32_t texel_bytes,
              const std::string& whose);

  /// Copies the texels in the first `bytes` bytes of `texels`, rectangle by rectangle, each row by
  /// row without gaps.
  void write(Commands& commands, const Buffer& texels, uint64_t bytes) const;

 private:
  BufferTarget buffer_;
  vk::Image image_;  // null: the target is a buffer
  vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
  std::vector<vk::BufferImageCopy> regions_;
};

}  // namespace hmlfc::gpu
