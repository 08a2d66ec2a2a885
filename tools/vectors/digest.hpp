// What the suite compares: decoded pictures as bytes, and the SHA-256 of files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/image.hpp>

namespace hmlfc::vectors {

/// The SHA-256 of `bytes` in 64 lower-case hexadecimal digits. Throws std::bad_alloc.
std::string sha256(std::span<const uint8_t> bytes);

/// The samples of `image`, row by row, R, G and B of a pixel together: one byte each at depth 8,
/// two, little-endian, above.
std::vector<uint8_t> picture_bytes(const RgbImage& image);

}  // namespace hmlfc::vectors
