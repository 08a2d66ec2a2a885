// Vectors and the values between samples against rational arithmetic (MOT-8, MOT-9).
#include "arithmetic/motion.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "arithmetic/naive_integers.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {
namespace {

using test::between;
using test::power_of_two;

// The integer nearest to the fraction numerator / denominator, the greater of two: found by trying.
int64_t nearest(int64_t numerator, int64_t denominator) {
  int64_t best = numerator / denominator - 2;
  const auto distance = [&](int64_t x) {
    const int64_t d = x * denominator - numerator;
    return d < 0 ? -d : d;
  };
  for (int64_t x = best; x <= numerator / denominator + 2; ++x) {
    if (distance(x) <= distance(best)) best = x;
  }
  return best;
}

MotionVector naive_vector(int64_t d, int64_t rows, int64_t cols, const VectorRules& rules) {
  // d is in 2^-s vector units for a step of one column, row_scale / 16 of that for one of a row.
  const int64_t unit = power_of_two(rules.shift);
  const int64_t x = nearest(d * cols, unit);
  const int64_t y = nearest(d * rules.row_scale * rows, 16 * unit);
  return {static_cast<int32_t>(between(-rules.bound, x, rules.bound)),
          static_cast<int32_t>(between(-rules.bound, y, rules.bound))};
}

TEST(DisparityVector, EveryDisparityAtSomeOffsets) {
  for (unsigned shift = 0; shift <= 5; ++shift) {
    for (const int32_t scale : {-127, -16, -1, 0, 1, 15, 16, 127}) {
      const VectorRules rules{1016, shift, scale};
      for (int32_t d = kMinDisparity; d <= kMaxDisparity; ++d) {
        for (const auto& [rows, cols] : {std::pair{-1, 1}, {2, -3}, {0, 0}, {7, 5}}) {
          ASSERT_EQ(disparity_vector(d, rows, cols, rules), naive_vector(d, rows, cols, rules))
              << d << " at " << rows << ", " << cols << ", s = " << shift << ", scale " << scale;
        }
      }
    }
  }
}

// The ends of every input at once: products of 29 bits (section 11).
TEST(DisparityVector, Extremes) {
  for (const int32_t bound : {0, 1, 127, 1016}) {
    for (unsigned shift = 0; shift <= 5; ++shift) {
      for (const int32_t scale : {-127, 127}) {
        const VectorRules rules{bound, shift, scale};
        for (const int32_t d : {kMinDisparity, kMinDisparity + 1, kMaxDisparity}) {
          for (const int32_t rows : {-1023, -382, -1, 0, 1, 382, 1023}) {
            for (const int32_t cols : {-1023, -382, 0, 382, 1023}) {
              const MotionVector got = disparity_vector(d, rows, cols, rules);
              ASSERT_EQ(got, naive_vector(d, rows, cols, rules));
              ASSERT_LE(got.x, bound);
              ASSERT_GE(got.y, -bound);
            }
          }
        }
      }
    }
  }
}

TEST(ExplicitVector, EveryComponentIsClamped) {
  for (const int32_t bound : {0, 1, 254, 1016}) {
    for (int32_t x = -2048; x <= 2047; ++x) {
      const MotionVector got = explicit_vector(x, -1 - x, {bound, 0, 0});
      ASSERT_EQ(got.x, between(-bound, x, bound));
      ASSERT_EQ(got.y, between(-bound, -1 - x, bound));
    }
  }
}

TEST(VectorRules, FollowTheHeader) {
  StreamHeader header;
  header.window = 127;
  header.feature_flags = feature_bit(Feature::kMotionTiles);
  EXPECT_EQ(vector_rules(header).bound, 127);
  EXPECT_EQ(vector_rules(header).shift, 0u);
  header.feature_flags |= feature_bit(Feature::kSubpelVectors);
  header.vector_precision = 3;
  EXPECT_EQ(vector_rules(header).bound, 1016);
  EXPECT_EQ(vector_rules(header).shift, 0u) << "without disparities there is nothing to shift";
  header.feature_flags |= feature_bit(Feature::kSharedDisparity);
  header.disparity_precision = 5;
  header.row_scale = -127;
  EXPECT_EQ(vector_rules(header).shift, 2u);
  EXPECT_EQ(vector_rules(header).row_scale, -127);
}

using test::floor_of;

// Every component of every precision: u of MOT-9 rebuilt from its parts.
TEST(SubpelVector, EveryComponent) {
  for (unsigned precision = 0; precision <= 3; ++precision) {
    const auto most = static_cast<int32_t>(127 * power_of_two(precision));
    for (int32_t v = -most; v <= most; ++v) {
      const int64_t eighths = v * power_of_two(3 - precision);
      // Half of it to the nearest, halves up.
      const int64_t halved = floor_of(eighths + 1, 2);
      for (const bool half : {false, true}) {
        const SubpelVector got = subpel_vector({v, -v}, precision, half);
        ASSERT_GE(got.fx, 0);
        ASSERT_LE(got.fx, 7);
        ASSERT_GE(got.fy, 0);
        ASSERT_LE(got.fy, 7);
        ASSERT_EQ(8 * got.ix + got.fx, half ? halved : eighths) << v << ", " << precision;
        ASSERT_EQ(8 * got.iy + got.fy, half ? floor_of(-eighths + 1, 2) : -eighths);
      }
    }
  }
}

// MOT-9 as it is written: two interpolations along x, one along y.
int64_t naive_sum(int64_t fx, int64_t fy, const std::array<int32_t, 4>& ref) {
  return (8 - fy) * ((8 - fx) * ref[0] + fx * ref[1]) + fy * ((8 - fx) * ref[2] + fx * ref[3]);
}

void check_all_fractions(const std::array<int32_t, 4>& samples) {
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  for (int32_t fy = 0; fy < 8; ++fy) {
    for (int32_t fx = 0; fx < 8; ++fx) {
      const int32_t sum = weighted_sum(tap_weights(fx, fy), samples);
      ASSERT_EQ(sum, naive_sum(fx, fy, samples)) << fx << ", " << fy;
      ASSERT_GE(sum, 64 * *least);
      ASSERT_LE(sum, 64 * *most);
      const int32_t value = one_reference_value(sum);
      ASSERT_EQ(value, floor_of(int64_t{sum} + 32, 64));
      ASSERT_GE(value, *least);
      ASSERT_LE(value, *most);
      if (fx == 0 && fy == 0) {
        ASSERT_EQ(value, samples[0]);
      }
    }
  }
}

// Each of the four samples at each end of the interval of section 11, with 0 and 1 between.
TEST(Interpolation, ExtremesOfEveryDepth) {
  for (int depth = 8; depth <= 12; ++depth) {
    for (const Plane plane : {Plane::kY, Plane::kCo}) {
      const int32_t m = sample_range(plane, depth).bound;
      const int32_t ends[] = {-m, -m + 1, -1, 0, 1, m};
      for (const int32_t a : ends) {
        for (const int32_t b : ends) {
          for (const int32_t c : ends) {
            for (const int32_t d : ends) check_all_fractions({a, b, c, d});
          }
        }
      }
    }
  }
}

// Every pair of sums that two samples at whole places can give at depth 8, and the ends of all.
TEST(Interpolation, TwoReferences) {
  for (int32_t a = -510; a <= 510; ++a) {
    for (int32_t b = -510; b <= 510; ++b) {
      ASSERT_EQ(two_reference_value(64 * a, 64 * b), floor_of(int64_t{a} + b + 1, 2));
    }
  }
  constexpr int32_t kMost = 64 * 8190;
  for (const int32_t a : {-kMost, -kMost + 1, -65, -64, -63, -1, 0, 1, 63, 64, kMost - 1, kMost}) {
    for (int32_t b = -kMost; b <= kMost; b += 61) {
      ASSERT_EQ(two_reference_value(a, b), floor_of(int64_t{a} + b + 64, 128)) << a << ", " << b;
    }
  }
}

}  // namespace
}  // namespace hmlfc
