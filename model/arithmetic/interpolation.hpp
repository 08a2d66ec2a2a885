// Displacements between samples and the values there (MOT-9).
#pragma once

#include <array>
#include <cstdint>

#include "arithmetic/disparity.hpp"
#include "arithmetic/rounding.hpp"
#include "arithmetic/watch.hpp"

namespace hmlfc {

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

/// Weights of the samples at (0, 0), (1, 0), (0, 1) and (1, 1); their sum is 64.
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
constexpr int32_t one_reference_value(int32_t sum) { return round_shift(sum, 6); }

/// I_first + I_second + 64 of MOT-9.
constexpr int32_t two_reference_sum(int32_t first, int32_t second) { return first + second + 64; }

/// R of MOT-9 with two references.
constexpr int32_t two_reference_value(int32_t first, int32_t second) {
  return floor_shift(two_reference_sum(first, second), 7);
}

}  // namespace hmlfc
