#include "vectors/picture_bytes.hpp"

#include "bits/little_endian.hpp"

namespace hmlfc::vectors {

std::vector<uint8_t> picture_bytes(const RgbImage& image) {
  std::vector<uint8_t> bytes;
  bytes.reserve(image.samples.size() * (image.depth > 8 ? 2 : 1));
  for (const uint16_t sample : image.samples) {
    if (image.depth > 8) {
      append_le(bytes, sample);
    } else {
      bytes.push_back(static_cast<uint8_t>(sample));
    }
  }
  return bytes;
}

}  // namespace hmlfc::vectors
