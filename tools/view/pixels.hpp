// Pictures as a browser's canvas takes them.
#pragma once

#include <string>

#include <hmlfc/image.hpp>

#include "view/exchange.hpp"

namespace hmlfc::view {

/// Four bytes a pixel, R, G, B and 255, row by row: the upper 8 bits of each sample.
std::string rgba_bytes(const RgbImage& image);

/// An answer with these pixels; the header Picture-Size has "width,height".
Response picture_answer(const RgbImage& image);

}  // namespace hmlfc::view
