// YCoCg-R over all colours and over all coefficients (COL-1, COL-2, STR-7).
#include "arithmetic/colour.hpp"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "arithmetic/widths.hpp"

namespace hmlfc {
namespace {

// Half of x, downwards, by division alone.
int32_t half(int32_t x) { return x % 2 == 0 ? x / 2 : (x - 1) / 2; }

// COL-1 with every intermediate value put in: Y = B + half(R - B) + half(Cg).
YCoCg naive_forward(const Rgb& p) {
  const int32_t cg = p.g - p.b - half(p.r - p.b);
  return {p.b + half(p.r - p.b) + half(cg), p.r - p.b, cg};
}

// COL-2 likewise, in 64 bits and clamped by sorting.
int64_t middle(int64_t lo, int64_t x, int64_t hi) { return std::max(lo, std::min(x, hi)); }

Rgb naive_inverse(const YCoCg& p, int depth) {
  const int64_t hi = (int64_t{1} << depth) - 1;
  const int64_t g = int64_t{p.y} + p.cg - half(p.cg);
  const int64_t b = int64_t{p.y} - half(p.cg) - half(p.co);
  const int64_t r = b + p.co;
  return {static_cast<int32_t>(middle(0, r, hi)), static_cast<int32_t>(middle(0, g, hi)),
          static_cast<int32_t>(middle(0, b, hi))};
}

struct Interval {
  int32_t least = 0;
  int32_t most = 0;
  void add(int32_t x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  friend bool operator==(const Interval&, const Interval&) = default;
};

Interval interval_of(Plane plane, int depth) {
  const SampleRange range = sample_range(plane, depth);
  return {range.lo, range.hi};
}

// All 2^24 colours: the formula, exact inversion, and ranges that are reached and never left.
TEST(Colour, AllColoursOfDepth8) {
  Interval y, co, cg;
  for (int32_t r = 0; r < 256; ++r) {
    for (int32_t g = 0; g < 256; ++g) {
      for (int32_t b = 0; b < 256; ++b) {
        const Rgb rgb{r, g, b};
        const YCoCg p = forward_colour(rgb);
        ASSERT_EQ(p, naive_forward(rgb)) << r << " " << g << " " << b;
        ASSERT_EQ(inverse_colour(p, 8), rgb) << r << " " << g << " " << b;
        y.add(p.y);
        co.add(p.co);
        cg.add(p.cg);
      }
    }
  }
  EXPECT_EQ(y, interval_of(Plane::kY, 8));
  EXPECT_EQ(co, interval_of(Plane::kCo, 8));
  EXPECT_EQ(cg, interval_of(Plane::kCg, 8));
}

// All 256 * 511 * 511 coefficient triples that a decoder can meet, most of them out of gamut.
TEST(Colour, InverseOfAllCoefficientsOfDepth8) {
  for (int32_t y = 0; y <= 255; ++y) {
    for (int32_t co = -255; co <= 255; ++co) {
      for (int32_t cg = -255; cg <= 255; ++cg) {
        const YCoCg p{y, co, cg};
        ASSERT_EQ(inverse_colour(p, 8), naive_inverse(p, 8)) << y << " " << co << " " << cg;
      }
    }
  }
}

RC_GTEST_PROP(Colour, InvertibleAtEveryDepth, ()) {
  const int depth = *rc::gen::inRange(8, 13);
  const auto sample = rc::gen::inRange(0, 1 << depth);
  const Rgb rgb{*sample, *sample, *sample};
  const YCoCg p = forward_colour(rgb);
  RC_ASSERT(p == naive_forward(rgb));
  RC_ASSERT(inverse_colour(p, depth) == rgb);
  const auto within = [](int32_t x, const Interval& range) {
    return range.least <= x && x <= range.most;
  };
  RC_ASSERT(within(p.y, interval_of(Plane::kY, depth)));
  RC_ASSERT(within(p.co, interval_of(Plane::kCo, depth)));
  RC_ASSERT(within(p.cg, interval_of(Plane::kCg, depth)));
}

}  // namespace
}  // namespace hmlfc
