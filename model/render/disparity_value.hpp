// Disparities from what motion holds (docs/rendering.md, GEO-4 to GEO-6).
#pragma once

#include <cstdint>

#include <hmlfc/disparity.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {

/// D lies in [kLeastD, kGreatestD] (GEO-1).
inline constexpr int32_t kLeastD = -(1 << 15);
inline constexpr int32_t kGreatestD = (1 << 15) - 1;

/// Of confidence (GEO-6).
inline constexpr uint8_t kUncertain = 1;
inline constexpr uint8_t kOwnDisparity = 2;
inline constexpr uint8_t kSharedDisparity = 3;

/// D of disparity `d` in [-4096, 4095], in units of 2^-precision samples a column of images that
/// are `apart` views apart; precision in [0, 5], apart in [1, 4096] (GEO-4).
///
/// Example: -3 with precision 2, three quarters of a sample in two views, gives -96.
constexpr int16_t scaled_disparity(int32_t d, unsigned precision, int32_t apart) {
  const int32_t scaled = d * (1 << (8 - precision));
  watch("d * 2^(8 - disparity_precision)", scaled);
  const int32_t rounded = 2 * (scaled < 0 ? -scaled : scaled) + apart;
  watch("2 * abs(d * 2^(8 - disparity_precision)) + kc", rounded);
  const int32_t size = rounded / (2 * apart);
  const int32_t D = clamp(scaled < 0 ? -size : size, kLeastD, kGreatestD);
  watch("D", D);
  return narrow<int16_t>(D);
}

/// A displacement in eighths of a sample, or a baseline in sixteenths of a column (GEO-5).
struct Span {
  int32_t x = 0;
  int32_t y = 0;
};

/// den of GEO-5; `baseline` is not 0 in both components.
constexpr int64_t squared_length(const Span& baseline) {
  watch("gx", baseline.x);
  watch("gy", baseline.y);
  const int64_t den = int64_t{baseline.x} * baseline.x + int64_t{baseline.y} * baseline.y;
  watch("den", den);
  return den;
}

/// D of the vector `v`, components in [-1016, 1016], along `baseline` (GEO-5).
///
/// Example: 24 eighths to the right over 32 sixteenths of a column: 3 pixels in 2 columns, 384.
constexpr int16_t vector_disparity(const Span& v, const Span& baseline) {
  watch("u, v", v.x);
  watch("u, v", v.y);
  const int64_t den = squared_length(baseline);
  const int64_t num = 512 * (int64_t{v.x} * baseline.x + int64_t{v.y} * baseline.y);
  watch("num", num);
  const int64_t rounded = 2 * (num < 0 ? -num : num) + den;
  watch("2 * abs(num) + den", rounded);
  const int64_t size = rounded / (2 * den);
  const int64_t most = num < 0 ? -int64_t{kLeastD} : int64_t{kGreatestD};
  const auto D = static_cast<int32_t>(size < most ? size : most);
  watch("D", num < 0 ? -D : D);
  return narrow<int16_t>(num < 0 ? -D : D);
}

/// Whether the vector `v` leads at most half a sample away from the line of `baseline` (GEO-6).
///
/// Example: (24, 4) eighths along columns does, (24, 5) does not.
constexpr bool is_along(const Span& v, const Span& baseline) {
  const int32_t aside = v.x * baseline.y - v.y * baseline.x;
  watch("u * gy - v * gx", aside);
  const int64_t squared = int64_t{aside} * aside;
  watch("(u * gy - v * gx)^2", squared);
  return squared <= 16 * squared_length(baseline);
}

}  // namespace hmlfc
