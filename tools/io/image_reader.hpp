// What the readers of the image formats share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include <hmlfc/image.hpp>

#include "io/image_files.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

inline constexpr uint32_t kMaxSide = 65536;

/// An image file in memory, to be decoded.
struct ImageSource {
  const std::filesystem::path& path;  ///< for messages
  std::span<const uint8_t> bytes;     ///< the whole file
  const ImageLimits& limits;
  Notes& notes;

  void note(std::string what) const { notes.add(path, std::move(what)); }

  /// Notes that samples of `bits` bits, [1, 16], became those of `image`, of 12, if they are more;
  /// also that these leave out what files with 12 bits in the lower ones of 16 hold.
  void note_depth(int bits, const RgbImage& image) const;

  /// Notes that `bytes` bytes after the picture are not read, if there are any.
  void note_surplus(size_t bytes) const;

  /// Notes an ICC profile that is not applied, unless it is that of sRGB, which its beginning
  /// tells.
  void note_profile(std::span<const uint8_t> profile) const;
};

/// What is wrong with the file: "FILE: what; the file is damaged".
tl::unexpected<IoError> damaged(const ImageSource& source, const std::string& what);

/// What the format allows and is not read here: "FILE: what; not supported: cure".
tl::unexpected<IoError> unsupported(const ImageSource& source, const std::string& what,
                                    const std::string& cure = "convert it to PNG");

/// An image of zeros with this size. Errors: a side outside [1, 65536], over the limit of samples,
/// out of memory.
IoResult<RgbImage> allocate_image(const ImageSource& source, uint64_t width, uint64_t height,
                                  int depth);

/// From bytes in the front of the samples' own memory to samples, backwards as they grow.
void widen_bytes(RgbImage& image);

/// The orientation in [1, 8] that EXIF data tells, with or without "Exif\0\0" in front; 1, which is
/// upright, where it tells none.
int exif_orientation(std::span<const uint8_t> exif);

/// `image` as it is meant to be seen, with a note unless `orientation` is 1. Errors: out of memory.
IoResult<RgbImage> upright(const ImageSource& source, RgbImage image, int orientation);

bool is_png(std::span<const uint8_t> bytes);
bool is_jpeg(std::span<const uint8_t> bytes);
bool is_pnm(std::span<const uint8_t> bytes);
bool is_tiff(std::span<const uint8_t> bytes);
bool is_webp(std::span<const uint8_t> bytes);

/// Each reader takes a source that its is_...() accepts; errors as for read_image().
IoResult<RgbImage> read_png(const ImageSource& source);
IoResult<RgbImage> read_jpeg(const ImageSource& source);
IoResult<RgbImage> read_pnm(const ImageSource& source);
IoResult<RgbImage> read_tiff(const ImageSource& source);
IoResult<RgbImage> read_webp(const ImageSource& source);

}  // namespace hmlfc::io
