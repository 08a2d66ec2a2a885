// Objective quality: what PSNR is computed from.
#pragma once

#include <cstdint>

#include <hmlfc/export.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc {

/// Squared and largest differences, in samples of RGB and of Y, the luma of YCoCg-R of that RGB.
struct HMLFC_EXPORT ErrorSums {
  uint64_t rgb_squares = 0;  ///< over all pixels and channels
  uint64_t y_squares = 0;    ///< over all pixels
  uint32_t max_abs = 0;      ///< largest |difference| of an RGB sample

  /// Adds the sums of `other`, of further pixels.
  void add(const ErrorSums& other);
};

/// The error of `b` against `a`, pictures of one size and depth. Exact up to 2^40 pixels.
HMLFC_EXPORT ErrorSums measure(const RgbImage& a, const RgbImage& b);

/// PSNR in dB of `squares` over `samples` samples of `depth` bits in [8, 12]; infinite for 0
/// squares.
HMLFC_EXPORT double psnr(uint64_t squares, uint64_t samples, int depth);

}  // namespace hmlfc
