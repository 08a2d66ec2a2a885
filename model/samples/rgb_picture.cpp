#include "samples/rgb_picture.hpp"

#include "values/colour.hpp"

namespace hmlfc {

Rect chroma_rect(const Rect& rect, bool halved) {
  if (!halved) return rect;
  const uint32_t x = rect.x >> 1;
  const uint32_t y = rect.y >> 1;
  return {x, y, ((rect.x + rect.width - 1) >> 1) - x + 1,
          ((rect.y + rect.height - 1) >> 1) - y + 1};
}

RgbImage rgb_picture(const std::array<SamplePlane, kPlaneCount>& planes, const Rect& rect,
                     bool halved, int depth) {
  RgbImage image{rect.width, rect.height, depth, {}};
  image.samples.resize(size_t{rect.width} * rect.height * 3);
  const Rect chroma = chroma_rect(rect, halved);
  const unsigned shift = halved ? 1 : 0;
  uint16_t* out = image.samples.data();
  for (uint32_t y = 0; y < rect.height; ++y) {
    const auto luma = planes[0].row(y);
    const auto co = planes[1].row(((rect.y + y) >> shift) - chroma.y);
    const auto cg = planes[2].row(((rect.y + y) >> shift) - chroma.y);
    for (uint32_t x = 0; x < rect.width; ++x) {
      const uint32_t c = ((rect.x + x) >> shift) - chroma.x;
      const Rgb pixel = inverse_colour({luma[x], co[c], cg[c]}, depth);
      *out++ = static_cast<uint16_t>(pixel.r);
      *out++ = static_cast<uint16_t>(pixel.g);
      *out++ = static_cast<uint16_t>(pixel.b);
    }
  }
  return image;
}

}  // namespace hmlfc
