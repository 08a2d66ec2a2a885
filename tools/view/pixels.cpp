#include "view/pixels.hpp"

#include <cstddef>

#include <fmt/format.h>

namespace hmlfc::view {

std::string rgba_bytes(const RgbImage& image) {
  const size_t pixels = size_t{image.width} * image.height;
  const int shift = image.depth - 8;
  std::string bytes(4 * pixels, '\xff');
  const uint16_t* in = image.samples.data();
  for (char* out = bytes.data(); out != bytes.data() + bytes.size(); out += 4, in += 3) {
    for (size_t k = 0; k < 3; ++k) out[k] = static_cast<char>(in[k] >> shift);
  }
  return bytes;
}

Response picture_answer(const RgbImage& image) {
  return {.type = "application/octet-stream",
          .body = rgba_bytes(image),
          .headers = {{"Picture-Size", fmt::format("{},{}", image.width, image.height)}}};
}

}  // namespace hmlfc::view
