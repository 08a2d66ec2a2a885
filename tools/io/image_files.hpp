// Pictures from and to files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/image.hpp>

#include "io/io_error.hpp"
#include "io/notes.hpp"

namespace hmlfc::io {

/// Bounds on what an image file may ask for.
struct ImageLimits {
  uint64_t max_samples = uint64_t{1} << 31;  ///< width * height * 3; checked before allocation
};

/// The note of a file that has bytes after its picture.
inline constexpr const char* kSurplusNote = "what follows the end of the picture is ignored";

/// Reads a PNG, JPEG, TIFF, WebP, PPM or PGM file; the content tells the format, not the name. What
/// is changed or left out is added to `notes`, unless it is null.
///
/// Grey is replicated to R, G and B, alpha and transparency are dropped, colour profiles and gamma
/// are ignored, palettes are looked up, the EXIF orientation is applied. Depth of the result and
/// its samples:
/// - JPEG, WebP, PNG of 1 to 8 bits, TIFF of 8 bits: depth 8, samples as stored (grey PNG of 1, 2
/// or
///   4 bits is stretched to 8);
/// - PNG and TIFF of 16 bits: depth d = the greatest count in PNG's sBIT chunk, clamped to [8, 12],
///   or 12 without sBIT; sample = value >> (16 - d);
/// - PNM of maxval 2^n - 1, n in [8, 16]: depth d = min(n, 12), sample = value >> (n - d);
/// - PNM of other maxval m, of n bits: depth d = n clamped to [8, 12], sample = value * (2^d - 1) /
/// m,
///   rounded.
///
/// Errors: not readable, not one of these kinds, a form that is not supported, truncated or
/// damaged, a side over 65536, more samples than `limits` allow or, but for WebP, than the file's
/// length can hold. Never crashes on any content.
IoResult<RgbImage> read_image(const std::filesystem::path& path, const ImageLimits& limits = {},
                              Notes* notes = nullptr);

/// Writes an RGB PNG: of 8 bits for depth 8; for depth d in [9, 16] of 16 bits, with sBIT = d and
/// value = sample << (16 - d) | sample >> (2d - 16), so that black stays 0 and white 65535.
/// read_image() returns exactly `image`, up to depth 12. The bytes depend on `image`, the version
/// of zlib and `software`, which stands near their beginning as the text "Software". `grey`: a grey
/// PNG, of the samples of R. Errors: cannot write.
IoResult<void> write_png(const std::filesystem::path& path, const RgbImage& image,
                         const std::string& software = {}, bool grey = false);

/// Writes a binary PPM (P6) of maxval 2^depth - 1, two big-endian bytes per sample above depth 8.
/// Errors: cannot write.
IoResult<void> write_ppm(const std::filesystem::path& path, const RgbImage& image);

/// Writes an animated PNG (APNG) that loops over `frames`, at least one, all of one size and depth,
/// with `rate` frames per second, in [1, 1000]. PNG readers show the first. Errors: cannot write.
IoResult<void> write_apng(const std::filesystem::path& path, std::span<const RgbImage> frames,
                          unsigned rate, const std::string& software = {});

/// The bytes that write_png writes; empty if memory runs out.
std::vector<uint8_t> encode_png(const RgbImage& image, const std::string& software = {},
                                bool grey = false);

}  // namespace hmlfc::io
