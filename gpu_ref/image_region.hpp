// Where texels go in an image of the caller.
#pragma once

#include <cstdint>

#include <hmlfc/gpu/recording.hpp>

#include "vulkan_hpp.hpp"

namespace hmlfc::gpu {

/// The copy of `extent` texels from byte `offset` of a buffer on, row by row without gaps, to place
/// `number` of `target`.
inline vk::BufferImageCopy region_of(const ImageTarget& target, size_t number, uint64_t offset,
                                     VkExtent2D extent) {
  const TexelPlace& place = target.places[number];
  const vk::ImageSubresourceLayers layer(vk::ImageAspectFlagBits::eColor, target.mip_level,
                                         place.layer, 1);
  const vk::Offset3D corner(static_cast<int32_t>(place.x), static_cast<int32_t>(place.y), 0);
  return {offset, 0, 0, layer, corner, vk::Extent3D(extent.width, extent.height, 1)};
}

}  // namespace hmlfc::gpu
