// R, G, B as the Y', Cb, Cr of videos (ITU-R BT.709), in integers.
#pragma once

#include <cstdint>

namespace hmlfc::io {

/// One pixel of a video.
struct YCbCr {
  int32_t y = 0;
  int32_t cb = 0;
  int32_t cr = 0;

  friend bool operator==(const YCbCr&, const YCbCr&) = default;
};

/// One pixel of a view.
struct Rgb {
  int32_t r = 0;
  int32_t g = 0;
  int32_t b = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// How a video counts.
struct VideoLevels {
  int bits = 8;             ///< a sample, [8, 16]
  bool full_range = false;  ///< Y' in [0, 2^bits - 1]; else in [16, 235] * 2^(bits - 8)
};

/// `pixel`, of samples in [0, 2^depth - 1] with `depth` in [8, 12], each component rounded to
/// nearest, halves upwards. rgb_of gives `pixel` back wherever bits >= depth + 2.
YCbCr ycbcr_of(const Rgb& pixel, int depth, const VideoLevels& levels);

/// The nearest pixel of `depth` bits, clamped to [0, 2^depth - 1]. `pixel` has samples in
/// [0, 2^bits - 1].
Rgb rgb_of(const YCbCr& pixel, int depth, const VideoLevels& levels);

}  // namespace hmlfc::io
