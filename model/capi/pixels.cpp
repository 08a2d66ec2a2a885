#include "capi/pixels.hpp"

#include <algorithm>
#include <cstddef>

#include "capi/structs.hpp"

namespace hmlfc::capi {

tl::expected<hmlfc_pixels, Refusal> read_pixels(const hmlfc_pixels* pixels, uint32_t width,
                                                uint32_t height, int depth) {
  auto into = read_struct(pixels, &hmlfc_pixels::reserved, "pixels");
  if (!into) return into;
  const auto wrong = [](const char* what) { return bad_argument("pixels", what); };
  const size_t sample_bytes = into->sample_bytes;
  if (into->data == nullptr) return wrong("has null as data");
  if (into->reserved != 0) return wrong("has a value in reserved");
  if (sample_bytes != 1 && sample_bytes != 2) return wrong("has sample_bytes other than 1 and 2");
  if (sample_bytes == 1 && depth > 8) return wrong("needs sample_bytes 2 above 8 bits");
  // At most 3 * 2 * 65536 bytes a row, 2^35 in all.
  const size_t row = size_t{3} * width * sample_bytes;
  if (into->stride == 0) into->stride = row;
  if (into->stride < row) return wrong("has a stride shorter than a row");
  const bool is_aligned = reinterpret_cast<uintptr_t>(into->data) % sample_bytes == 0;
  if (!is_aligned || into->stride % sample_bytes != 0) return wrong("is not aligned to samples");
  // bytes >= stride * (height - 1) + row, without overflow.
  const bool fits = into->bytes >= row && (into->bytes - row) / into->stride >= height - 1;
  if (!fits) return wrong("has too few bytes for the pixels");
  return into;
}

void store(const RgbImage& image, const hmlfc_pixels& pixels) {
  const size_t count = size_t{3} * image.width;
  const uint16_t* from = image.samples.data();
  auto* row = static_cast<std::byte*>(pixels.data);
  for (uint32_t y = 0; y < image.height; ++y, from += count, row += pixels.stride) {
    if (pixels.sample_bytes == 1) {
      std::copy_n(from, count, reinterpret_cast<uint8_t*>(row));
    } else {
      std::copy_n(from, count, reinterpret_cast<uint16_t*>(row));
    }
  }
}

}  // namespace hmlfc::capi
