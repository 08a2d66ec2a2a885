// Pictures for tests, and PNG and JPEG files of kinds that the library itself never writes.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/image.hpp>

#include "io/temp_folder.hpp"

namespace hmlfc::test {

/// Independent uniform samples; the least and the greatest value are among them.
RgbImage random_image(uint32_t width, uint32_t height, int depth, uint32_t seed);

/// What a PNG file holds, in PNG's own terms.
struct PngContent {
  uint32_t width = 1;
  uint32_t height = 1;
  int bit_depth = 8;
  int colour_type = 2;    ///< 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
  Bytes rows{};           ///< packed as PNG packs them, 16 bits big-endian
  Bytes palette{};        ///< three bytes an entry
  Bytes palette_alpha{};  ///< tRNS of a palette, or empty
  bool interlaced = false;
  Bytes significant{};  ///< content of sBIT, or empty for none
};

/// The bytes of such a PNG file.
Bytes make_png(const PngContent& content);

/// The rows of a PNG file that is not interlaced, packed as they are stored.
Bytes stored_rows(const Bytes& png_file);

struct JpegContent {
  uint32_t width = 1;
  uint32_t height = 1;
  int channels = 3;  ///< 1 grey, 3 RGB, 4 CMYK
  Bytes pixels{};
  bool progressive = false;
  bool full_chroma = true;  ///< 4:4:4, else 4:2:0
};

/// The bytes of a JPEG file of the best quality.
Bytes make_jpeg(const JpegContent& content);

}  // namespace hmlfc::test
