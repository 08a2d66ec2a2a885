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

  /// Notes that samples of `bits` bits become those of 12, if they are more.
  void note_depth(int bits) const {
    if (bits <= 12) return;
    note("samples of " + std::to_string(bits) +
         " bits are reduced to 12 bits, the most that a stream holds");
  }
};

/// An image of zeros with this size. Errors: a side outside [1, 65536], over the limit of samples,
/// out of memory.
IoResult<RgbImage> allocate_image(const ImageSource& source, uint64_t width, uint64_t height,
                                  int depth);

bool is_png(std::span<const uint8_t> bytes);
bool is_jpeg(std::span<const uint8_t> bytes);
bool is_pnm(std::span<const uint8_t> bytes);

/// Each reader takes a source that its is_...() accepts; errors as for read_image().
IoResult<RgbImage> read_png(const ImageSource& source);
IoResult<RgbImage> read_jpeg(const ImageSource& source);
IoResult<RgbImage> read_pnm(const ImageSource& source);

}  // namespace hmlfc::io
