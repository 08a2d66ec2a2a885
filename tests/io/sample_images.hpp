// Pictures for tests, and files of kinds that the library itself never writes.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
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
  Bytes significant{};                                  ///< content of sBIT, or empty for none
  std::vector<std::pair<std::string, Bytes>> chunks{};  ///< more of them, before the samples
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
  int h = 1;  ///< of the luma to the chroma: 1 and 1 are 4:4:4, 2 and 2 are 4:2:0
  int v = 1;
  unsigned restart = 0;  ///< blocks between two restart markers
  bool adobe = false;    ///< with Adobe's marker instead of JFIF's
  Bytes exif{};          ///< content of APP1, or empty for none
};

/// The bytes of a JPEG file of the best quality.
Bytes make_jpeg(const JpegContent& content);

/// EXIF data, as PNG has it: the orientation alone, in the order of bytes "II" or "MM".
Bytes make_exif(uint8_t orientation, const std::string& order = "II");

/// What a TIFF file holds, in TIFF's own terms.
struct TiffContent {
  uint32_t width = 1;
  uint32_t height = 1;
  uint16_t bits = 8;
  uint16_t channels = 3;
  std::vector<uint16_t> samples{};  ///< row by row, pixel by pixel
  uint16_t colours = 2;             ///< 0 and 1 grey, 2 RGB
  uint16_t coding = 1;              ///< 1 none, 5 LZW, 8 Deflate, 32773 PackBits
  uint16_t planes = 1;              ///< 2: one after the other
  uint32_t tile = 0;                ///< side of the tiles, a multiple of 16; 0: strips of two rows
  uint16_t orientation = 1;
  uint16_t format = 1;       ///< of the samples
  uint32_t subfile = 0;      ///< 1: a preview
  const char* order = "wl";  ///< "wl" or "wb": the lowest or the highest byte first
  unsigned pictures = 1;     ///< the same so many times
};

/// The bytes of such a TIFF file.
Bytes make_tiff(const TiffContent& content);

/// The bytes of a lossless WebP file of these RGB pixels, with these EXIF data if there are any.
Bytes make_webp(uint32_t width, uint32_t height, const Bytes& pixels, const Bytes& exif = {});

}  // namespace hmlfc::test
