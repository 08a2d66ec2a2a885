// Samples to pixels (COL-2, COL-3) and back (COL-1), with vectors of the instruction set chosen at
// run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>

#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// The samples of a row of pixels, in their ranges (STR-7).
struct ColourRow {
  const int16_t* y = nullptr;
  const int16_t* co = nullptr;  ///< of the first pixel, whose x is even where chroma is halved
  const int16_t* cg = nullptr;
  size_t pixels = 0;
  bool halved = false;  ///< two pixels share a sample of Co and Cg
  int depth = 8;        ///< [8, 12]
};

/// R, G and B of each pixel.
void write_rgb(const ColourRow& row, uint16_t* out);

/// R, G, B and 0 of each pixel; at depth 8.
void write_rgbx(const ColourRow& row, uint8_t* out);

/// R, G, B and 0 of each pixel.
void write_rgbx(const ColourRow& row, uint16_t* out);

/// Y, Co and Cg of `pixels` times R, G and B, each in [0, 4095].
void read_rgb(const uint16_t* rgb, size_t pixels, int16_t* y, int16_t* co, int16_t* cg);

/// The samples of Co and Cg that the pixels of `rect` take (COL-3); `rect` itself where they are
/// not `halved`.
Rect chroma_rect(const Rect& rect, bool halved);

/// The pixels of `rect`: planes[0] holds its samples of Y, planes[1] and planes[2] those of
/// chroma_rect(rect, halved). Planes may be larger; the rest is not used.
RgbImage rgb_picture(const std::array<SamplePlane, kPlaneCount>& planes, const Rect& rect,
                     bool halved, int depth);

}  // namespace hmlfc
