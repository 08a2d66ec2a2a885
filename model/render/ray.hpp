// One pixel's ray in integers (docs/rendering.md, section 3).
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/camera.hpp>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {

/// Slopes in units of 2^-28, in [-(2^30 - 1), 2^30 - 2] (RAY-2).
struct Slopes {
  int32_t x = 0;
  int32_t y = 0;
};

/// Where a ray that is inside meets the light field (RAY-3, RAY-4).
struct Ray {
  int32_t u = 0;   ///< [0, (cols - 1) * 2^16], units of 2^-16 steps
  int32_t v = 0;   ///< [0, (rows - 1) * 2^16]
  int32_t us = 0;  ///< Us of SRF-2: [-2^15, (cols - 1) * 2^16 + 2^15]
  int32_t vs = 0;  ///< [-2^15, (rows - 1) * 2^16 + 2^15]
  int32_t xb = 0;  ///< units of 2^-12 pixels
  int32_t yb = 0;
};

/// Half a step of views in the units of RAY-3, half a pixel in those of RAY-4.
inline constexpr int32_t kHalfStep = 1 << 15;
inline constexpr int32_t kHalfPixel = 1 << 11;

/// One component of a direction (RAY-1): a, b in [-4095, 4095].
constexpr int32_t direction(int32_t n0_hi, int32_t n0_lo, int32_t na_hi, int32_t na_lo,
                            int32_t nb_hi, int32_t nb_lo, int32_t a, int32_t b) {
  const int32_t low = n0_lo + a * na_lo + b * nb_lo;
  watch("na_lo * a + nb_lo * b + n0_lo", low);
  const int32_t n = n0_hi + a * na_hi + b * nb_hi + floor_shift(low, 12);
  watch("n", n);
  return n;
}

/// The direction at `a`, `b` in [-4095, 4095] (RAY-1).
constexpr IntVector direction(const FrameRecord& f, int32_t a, int32_t b) {
  watch("a, b", a);
  watch("a, b", b);
  return {direction(f.n0_hi.x, f.n0_lo.x, f.na_hi.x, f.na_lo.x, f.nb_hi.x, f.nb_lo.x, a, b),
          direction(f.n0_hi.y, f.n0_lo.y, f.na_hi.y, f.na_lo.y, f.nb_hi.y, f.nb_lo.y, a, b),
          direction(f.n0_hi.z, f.n0_lo.z, f.na_hi.z, f.na_lo.z, f.nb_hi.z, f.nb_lo.z, a, b)};
}

/// Whether the camera looks along Z: the rays of a column of pixels are then the same in x, those
/// of a row the same in y.
constexpr bool looks_along_z(const FrameRecord& f) {
  return f.na_hi.y == 0 && f.na_lo.y == 0 && f.na_hi.z == 0 && f.na_lo.z == 0 && f.nb_hi.x == 0 &&
         f.nb_lo.x == 0 && f.nb_hi.z == 0 && f.nb_lo.z == 0;
}

/// w of RAY-2: the reciprocal of n.z in [2^26, 805131608].
constexpr int32_t reciprocal(int32_t nz) {
  const auto w = static_cast<int32_t>(((uint64_t{1} << 57) - 1) / static_cast<uint64_t>(nz));
  watch("w", w);
  return w;
}

/// sx or sy of RAY-2: the slope of a component n with abs(n) < 4 * n.z, w = reciprocal(n.z).
constexpr int32_t slope_of(int32_t n, int32_t w) {
  const int64_t product = int64_t{n} * w;
  watch("n * w", product);
  const auto s = static_cast<int32_t>(product >> 29);
  watch("sx, sy", s);
  return s;
}

/// The lateral shift of a ray of `slope` (RAY-3, RAY-4): zu, zv or gain in [-2^28, 2^28] times the
/// slope.
constexpr int32_t shift_along(int32_t factor, int32_t slope) {
  const int64_t product = int64_t{factor} * slope;
  watch("zu * sx, gain * sx", product);
  return static_cast<int32_t>(product >> 28);
}

/// RAY-2; nothing for a pixel that is outside.
constexpr std::optional<Slopes> slopes(const IntVector& n) {
  const int32_t x = n.x < 0 ? -n.x : n.x;
  const int32_t y = n.y < 0 ? -n.y : n.y;
  if (n.z < (1 << 26) || (x >> 2) >= n.z || (y >> 2) >= n.z) return std::nullopt;
  const int32_t w = reciprocal(n.z);
  return Slopes{slope_of(n.x, w), slope_of(n.y, w)};
}

/// U or V on an axis of `views` views (RAY-3).
struct AxisPlace {
  int32_t inside = 0;     ///< in the grid: [0, (views - 1) * 2^16]
  int32_t displaced = 0;  ///< Us or Vs of SRF-2, up to half a step beyond it
};

/// The place on one axis of the grid of `views` views (RAY-3, SRF-2); nothing outside it.
constexpr std::optional<AxisPlace> place_among_views(int32_t place, int32_t views) {
  watch("U, V before their clamp", place);
  const int32_t last = (views - 1) << 16;
  if (views > 1 && (place < -kHalfStep || place > last + kHalfStep)) return std::nullopt;
  return AxisPlace{clamp(place, 0, last), clamp(place, -kHalfStep, last + kHalfStep)};
}

/// Whether a coordinate lies in a picture of `size` pixels along its axis (RAY-5).
constexpr bool is_in_picture(int32_t x, int32_t size) {
  return x >= -kHalfPixel && x <= (size << 12) - kHalfPixel - 1;
}

/// The nearest view on one axis (RAY-5).
constexpr int32_t nearest_view(int32_t place) { return (place + kHalfStep) >> 16; }

/// x(c) of RAY-4.
constexpr int32_t x_in_view(const FrameRecord& f, int32_t xb, int32_t col) {
  const int32_t x = xb + f.dx * (col - f.c0);
  watch("x(c), y(r)", x);
  return x;
}

/// y(r) of RAY-4.
constexpr int32_t y_in_view(const FrameRecord& f, int32_t yb, int32_t row) {
  const int32_t y = yb + f.dy * (row - f.r0);
  watch("x(c), y(r)", y);
  return y;
}

/// The ray of direction `n`; nothing if it is outside (RAY-2 to RAY-5).
constexpr std::optional<Ray> trace(const FrameRecord& f, const IntVector& n) {
  const auto slope = slopes(n);
  if (!slope) return std::nullopt;
  const auto u = place_among_views(f.u0 - shift_along(f.zu, slope->x), f.cols);
  const auto v = place_among_views(f.v0 - shift_along(f.zv, slope->y), f.rows);
  if (!u || !v) return std::nullopt;
  const Ray ray{u->inside,
                v->inside,
                u->displaced,
                v->displaced,
                f.x0 + shift_along(f.gain, slope->x),
                f.y0 + shift_along(f.gain, slope->y)};
  watch("xb, yb", ray.xb);
  watch("xb, yb", ray.yb);
  if (!is_in_picture(x_in_view(f, ray.xb, nearest_view(ray.u)), f.width) ||
      !is_in_picture(y_in_view(f, ray.yb, nearest_view(ray.v)), f.height)) {
    return std::nullopt;
  }
  return ray;
}

/// The ray of pixel (i, j); nothing if the pixel is outside (RAY-6).
constexpr std::optional<Ray> trace(const FrameRecord& f, int32_t i, int32_t j) {
  return trace(f, direction(f, 2 * i + 1 - f.frame_width, 2 * j + 1 - f.frame_height));
}

}  // namespace hmlfc
