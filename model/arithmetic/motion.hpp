// Vectors of motion tiles and the values between samples (MOT-8, MOT-9).
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/format.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

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

/// Fields of the header about vectors (EXT-2).
struct VectorRules {
  int32_t bound = 0;      ///< V of MOT-8: largest magnitude of a component; [0, 1016]
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

/// A displacement as whole samples and eighths of a sample beyond them.
struct SubpelVector {
  int32_t ix = 0;
  int32_t iy = 0;
  int32_t fx = 0;  ///< [0, 7]
  int32_t fy = 0;  ///< [0, 7]
  friend bool operator==(const SubpelVector&, const SubpelVector&) = default;
};

/// Splits vector `v` (MOT-9). `vector_precision` in [0, 3]; `halved`: for a plane of half the width
/// and height of the motion plane.
///
/// Example: (-3, 5) with precision 2 is (-6, 10) eighths: ix -1, fx 2, iy 1, fy 2; halved it is
/// (-3, 5) eighths, u = (u + 1) >> 1: ix -1, fx 5, iy 0, fy 5.
constexpr SubpelVector subpel_vector(MotionVector v, unsigned vector_precision, bool halved) {
  const auto eighths = [&](int32_t component) {
    const int32_t u = component * (1 << (3 - vector_precision));
    watch("u", u);
    return halved ? round_shift(u, 1) : u;
  };
  const int32_t ux = eighths(v.x);
  const int32_t uy = eighths(v.y);
  const int32_t ix = floor_shift(ux, 3);
  const int32_t iy = floor_shift(uy, 3);
  return {ix, iy, ux - 8 * ix, uy - 8 * iy};
}

/// Weights of the samples at (0, 0), (1, 0), (0, 1) and (1, 1); they sum to 64.
using TapWeights = std::array<int32_t, 4>;

/// The weights of fractions `fx` and `fy` in [0, 7].
///
/// Example: fx = 2, fy = 0 gives 48, 16, 0, 0.
constexpr TapWeights tap_weights(int32_t fx, int32_t fy) {
  return {(8 - fx) * (8 - fy), fx * (8 - fy), (8 - fx) * fy, fx * fy};
}

/// I of MOT-9 from the four samples in the order of `weights`; in 64 times their interval.
constexpr int32_t weighted_sum(const TapWeights& weights, const std::array<int32_t, 4>& samples) {
  return weights[0] * samples[0] + weights[1] * samples[1] + weights[2] * samples[2] +
         weights[3] * samples[3];
}

/// R of MOT-9 with one reference.
constexpr int32_t one_reference_value(int32_t sum) { return floor_shift(sum + 32, 6); }

/// I_first + I_second + 64 of MOT-9.
constexpr int32_t two_reference_sum(int32_t first, int32_t second) { return first + second + 64; }

/// R of MOT-9 with two references.
constexpr int32_t two_reference_value(int32_t first, int32_t second) {
  return floor_shift(two_reference_sum(first, second), 7);
}

}  // namespace hmlfc
