// The YCoCg-R colour transform (COL-1, COL-2).
#pragma once

#include <cstdint>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {

struct YCoCg {
  int32_t y, co, cg;
  friend bool operator==(const YCoCg&, const YCoCg&) = default;
};

struct Rgb {
  int32_t r, g, b;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Forward transform (COL-1). With R, G, B in [0, 2^n - 1]: y in [0, 2^n - 1], co and cg in
/// [-(2^n - 1), 2^n - 1]. inverse_colour(forward_colour(p), n) = p for every p.
constexpr YCoCg forward_colour(Rgb p) {
  const int32_t co = p.r - p.b;
  const int32_t t = p.b + floor_shift(co, 1);
  const int32_t cg = p.g - t;
  return {t + floor_shift(cg, 1), co, cg};
}

/// Inverse transform (COL-2) of samples in their ranges (STR-7); result in [0, 2^depth - 1].
constexpr Rgb inverse_colour(YCoCg p, int depth) {
  const int32_t hi = (int32_t{1} << depth) - 1;
  const int32_t t = p.y - floor_shift(p.cg, 1);
  const int32_t g = p.cg + t;
  const int32_t b = t - floor_shift(p.co, 1);
  const int32_t r = b + p.co;
  watch("t", t, depth);
  watch("G before its clamp", g, depth);
  watch("B before its clamp", b, depth);
  watch("R before its clamp", r, depth);
  return {clamp(r, 0, hi), clamp(g, 0, hi), clamp(b, 0, hi)};
}

}  // namespace hmlfc
