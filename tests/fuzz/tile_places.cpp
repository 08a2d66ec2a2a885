#include "tile_places.hpp"

#include "decoder/open_stream.hpp"

namespace hmlfc::fuzz {
namespace {

void for_each_image(const StreamView& stream,
                    const std::function<void(int level, ImagePos image)>& take) {
  for (int level = stream.geometry.top(); level >= 0; --level) {
    for (const ImagePos image : stream.geometry.level(level).all_images()) take(level, image);
  }
}

}  // namespace

std::optional<StreamView> open_view(std::span<const uint8_t> file) {
  auto stream = open_stream(file, {.check_sections = false});
  if (!stream) return std::nullopt;
  return std::move(*stream);
}

void for_each_tile(const StreamView& stream, const std::function<void(const BlockSite&)>& take) {
  for_each_image(stream, [&](int level, ImagePos image) {
    if (stream.geometry.is_key(level, image)) return;
    for (const Plane plane : kPlanes) {
      const PlaneShape& shape = stream.geometry.plane(plane);
      for (uint32_t by = 0; by < shape.blocks_y; by += kTileBlocks) {
        for (uint32_t bx = 0; bx < shape.blocks_x; bx += kTileBlocks) {
          take({level, image.row, image.col, plane, bx, by});
        }
      }
    }
  });
}

void for_each_motion_tile(const StreamView& stream, bool references,
                          const std::function<void(const MotionTilePlace&)>& take) {
  for_each_image(stream, [&](int level, ImagePos image) {
    if (stream.geometry.is_reference(level, image) != references) return;
    const auto& planes = stream.geometry.motion_planes();
    for (size_t m = 0; m < planes.size(); ++m) {
      for (uint32_t ty = 0; ty < planes[m].tiles_y; ++ty) {
        for (uint32_t tx = 0; tx < planes[m].tiles_x; ++tx) take({level, image, m, tx, ty});
      }
    }
  });
}

}  // namespace hmlfc::fuzz
