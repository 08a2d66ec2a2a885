// Pictures to PNG files in memory.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/image.hpp>

namespace hmlfc::io {

/// The bytes of write_png's file; none where memory runs out.
std::vector<uint8_t> encode_png(const RgbImage& image);

}  // namespace hmlfc::io
