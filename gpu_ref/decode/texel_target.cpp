#include "texel_target.hpp"

namespace hmlfc::gpu {

TexelTarget::TexelTarget(const ImageTarget& target, std::span<const VkExtent2D> extents,
                         uint32_t texel_bytes, const std::string& whose)
    : image_(target.image), layout_(vk::ImageLayout(target.layout)) {
  if (target.places.size() != extents.size()) {
    throw MachineError(
        FailureKind::kLimit,
        "ImageTarget::places has " + std::to_string(target.places.size()) + " places for " + whose);
  }
  uint64_t offset = 0;
  for (size_t i = 0; i < extents.size(); ++i) {
    const auto [width, height] = extents[i];
    if (width == 0 || height == 0) continue;
    const TexelPlace& place = target.places[i];
    const vk::ImageSubresourceLayers layer(vk::ImageAspectFlagBits::eColor, target.mip_level,
                                           place.layer, 1);
    const vk::Offset3D corner(static_cast<int32_t>(place.x), static_cast<int32_t>(place.y), 0);
    regions_.emplace_back(offset, 0, 0, layer, corner, vk::Extent3D(width, height, 1));
    offset += uint64_t{texel_bytes} * width * height;
  }
}

void TexelTarget::write(Commands& commands, const Buffer& texels, uint64_t bytes) const {
  if (image_) {
    commands.copy_out(texels, image_, layout_, regions_);
  } else {
    commands.copy_out(texels, bytes, buffer_.buffer, buffer_.offset);
  }
}

}  // namespace hmlfc::gpu
