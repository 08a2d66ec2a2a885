// One colour picture in memory: interleaved RGB samples of 8 to 12 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hmlfc {

/// A W x H picture, row-major, three interleaved samples R, G, B a pixel.
struct RgbImage {
  uint32_t width = 0;             ///< [1, 65536]
  uint32_t height = 0;            ///< [1, 65536]
  int depth = 8;                  ///< bits a sample, [8, 12]
  std::vector<uint16_t> samples;  ///< width * height * 3 values in [0, 2^depth - 1]
};

}  // namespace hmlfc
