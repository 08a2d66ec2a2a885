// Pictures to files. Each file appears complete or not at all (see AtomicFile).
#pragma once

#include <filesystem>

#include <hmlfc/image.hpp>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// Writes an RGB PNG: of 8 bits for depth 8; for depth d in [9, 12] of 16 bits, with sBIT = d and
/// value = sample << (16 - d) | sample >> (2d - 16), so that black stays 0 and white 65535.
/// read_image() returns exactly `image`. The bytes depend on `image` and the version of zlib only.
/// Errors: cannot write.
IoResult<void> write_png(const std::filesystem::path& path, const RgbImage& image);

/// Writes a binary PPM (P6) of maxval 2^depth - 1, two big-endian bytes a sample above depth 8.
/// Errors: cannot write.
IoResult<void> write_ppm(const std::filesystem::path& path, const RgbImage& image);

}  // namespace hmlfc::io
