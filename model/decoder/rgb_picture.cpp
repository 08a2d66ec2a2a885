#include "decoder/rgb_picture.hpp"

#include "decoder/colour_row.hpp"

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
  // A first pixel at an odd x has the second half of its sample of chroma.
  const bool odd = halved && rect.x % 2 != 0;
  for (uint32_t y = 0; y < rect.height; ++y) {
    const auto luma = planes[0].row(y);
    const uint32_t row = ((rect.y + y) >> shift) - chroma.y;
    const int16_t* co = planes[1].row(row).data();
    const int16_t* cg = planes[2].row(row).data();
    uint16_t* out = image.samples.data() + size_t{y} * rect.width * 3;
    if (odd) write_rgb({luma.data(), co, cg, 1, true, depth}, out);
    const uint32_t first = odd ? 1 : 0;
    write_rgb({luma.data() + first, co + first, cg + first, rect.width - first, halved, depth},
              out + 3 * first);
  }
  return image;
}

}  // namespace hmlfc
