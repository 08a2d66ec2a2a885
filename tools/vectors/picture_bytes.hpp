// Decoded pictures as the bytes that the suite compares (vectors/README.md, raw form).
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/image.hpp>

namespace hmlfc::vectors {

/// The samples of `image`, row by row, R, G and B of a pixel together: one byte each at depth 8,
/// two, little-endian, above.
std::vector<uint8_t> picture_bytes(const RgbImage& image);

}  // namespace hmlfc::vectors
