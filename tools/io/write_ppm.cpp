#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/write_image.hpp"

namespace hmlfc::io {

IoResult<void> write_ppm(const std::filesystem::path& path, const RgbImage& image) {
  const std::string header = "P6\n" + std::to_string(image.width) + " " +
                             std::to_string(image.height) + "\n" +
                             std::to_string((1 << image.depth) - 1) + "\n";
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.reserve(header.size() + image.samples.size() * (image.depth > 8 ? 2 : 1));
  for (const uint16_t sample : image.samples) {
    if (image.depth > 8) bytes.push_back(static_cast<uint8_t>(sample >> 8));
    bytes.push_back(static_cast<uint8_t>(sample));
  }
  return write_file(path, bytes);
}

}  // namespace hmlfc::io
