// Pictures from files, whatever their kind.
#pragma once

#include <cstdint>
#include <filesystem>

#include <hmlfc/image.hpp>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// Bounds on what a picture file may ask for.
struct ImageLimits {
  uint64_t max_samples = uint64_t{1} << 31;  ///< width * height * 3; checked before allocation
};

/// Reads a PNG, PPM/PGM or JPEG file; the kind is told by the content, not by the name.
///
/// Grey is replicated to R, G and B, alpha and transparency are dropped, colour profiles and gamma
/// are ignored, palettes are looked up. Depth of the result and its samples:
/// - JPEG, PNG of 1 to 8 bits, PNM of maxval 255: depth 8, samples as stored (grey PNG of 1, 2 or 4
///   bits is stretched to 8);
/// - PNG of 16 bits: depth d = the greatest count in the sBIT chunk, clamped to [8, 12], or 12
///   without sBIT; sample = value >> (16 - d);
/// - PNM of maxval 2^n - 1, n in [8, 16]: depth d = min(n, 12), sample = value >> (n - d).
///
/// Errors: not readable, not one of these kinds, truncated or damaged, a side over 65536, more
/// samples than `limits` allow or than the file's length can hold. Never crashes on any content.
IoResult<RgbImage> read_image(const std::filesystem::path& path, const ImageLimits& limits = {});

}  // namespace hmlfc::io
