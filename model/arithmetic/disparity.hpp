// Vectors of motion tiles (MOT-8).
#pragma once

#include <cstdint>

#include <hmlfc/format.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/watch.hpp"

namespace hmlfc {

/// Disparities lie in [kMinDisparity, kMaxDisparity] (MOT-6).
inline constexpr int32_t kMinDisparity = -4096;
inline constexpr int32_t kMaxDisparity = 4095;

/// A displacement in units of 2^-vector_precision samples.
struct MotionVector {
  int32_t x = 0;
  int32_t y = 0;
  friend bool operator==(const MotionVector&, const MotionVector&) = default;
};

/// What the header says about vectors (EXT-2).
struct VectorRules {
  int32_t bound = 0;      ///< V of MOT-8: greatest magnitude of a component; [0, 1016]
  unsigned shift = 0;     ///< s of MOT-8: disparity_precision - vector_precision; [0, 5]
  int32_t row_scale = 0;  ///< [-127, 127]
};

/// The rules of a stream with motion tiles.
inline VectorRules vector_rules(const StreamHeader& header) {
  const bool disparities = header.has(Feature::kSharedDisparity);
  return {header.window << header.vector_precision,
          disparities ? header.disparity_precision - header.vector_precision : 0u,
          header.row_scale};
}

/// (x, y) with both components clamped to [-bound, bound] (MOT-8).
constexpr MotionVector bounded_vector(int32_t x, int32_t y, const VectorRules& rules) {
  const MotionVector vector{clamp(x, -rules.bound, rules.bound),
                            clamp(y, -rules.bound, rules.bound)};
  watch("vx, vy", vector.x);
  watch("vx, vy", vector.y);
  return vector;
}

/// The vector that disparity `d` in [kMinDisparity, kMaxDisparity] gives (MOT-8). `row_offset` is
/// rk - r and `col_offset` ck - c, from the image to the reference image; |row_offset| <= 1023.
/// Both components lie in [-bound, bound].
///
/// Example: bound 64, shift 2, row_scale 16: disparity 6 at offsets (-1, 1) gives (2, -1).
constexpr MotionVector disparity_vector(int32_t d, int32_t row_offset, int32_t col_offset,
                                        const VectorRules& rules) {
  const int32_t scaled = d * rules.row_scale * row_offset;
  watch("disparity", d);
  watch("rk - r, ck - c", row_offset);
  watch("rk - r, ck - c", col_offset);
  watch("d * row_scale * (rk - r)", scaled);
  const int32_t x = round_shift(d * col_offset, rules.shift);
  const int32_t y = round_shift(scaled, rules.shift + 4);
  return bounded_vector(x, y, rules);
}

/// The vector of choice 11 (MOT-8); x and y in [-2048, 2047].
constexpr MotionVector explicit_vector(int32_t x, int32_t y, const VectorRules& rules) {
  watch("explicit_x, explicit_y", x);
  watch("explicit_x, explicit_y", y);
  return bounded_vector(x, y, rules);
}

}  // namespace hmlfc
