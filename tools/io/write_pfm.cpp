#include "io/disparity_files.hpp"

#include <bit>
#include <string>
#include <vector>

#include "io/files.hpp"

namespace hmlfc::io {

IoResult<void> write_pfm(const std::filesystem::path& path, uint32_t width, uint32_t height,
                         std::span<const float> pixels) {
  // The scale is negative for little-endian numbers.
  const std::string head =
      "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  std::vector<uint8_t> bytes(head.begin(), head.end());
  bytes.reserve(bytes.size() + pixels.size() * sizeof(float));
  // The format begins with the lowest row.
  for (uint32_t y = height; y-- > 0;) {
    for (const float pixel : pixels.subspan(size_t{y} * width, width)) {
      const auto word = std::bit_cast<uint32_t>(pixel);
      for (unsigned shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<uint8_t>(word >> shift));
      }
    }
  }
  return write_file(path, bytes);
}

}  // namespace hmlfc::io
