// Vectors from disparities against rational arithmetic (MOT-8).
#include "arithmetic/motion.hpp"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/naive_integers.hpp"

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

TEST(DisparityVector, Random) {
  std::mt19937 random(1);
  const auto draw = [&](int lo, int hi) { return std::uniform_int_distribution(lo, hi)(random); };
  for (int i = 0; i < 500000; ++i) {
    const VectorRules rules{draw(0, 1016), static_cast<unsigned>(draw(0, 5)), draw(-127, 127)};
    const int32_t d = draw(kMinDisparity, kMaxDisparity);
    const int32_t rows = draw(-400, 400);
    const int32_t cols = draw(-400, 400);
    ASSERT_EQ(disparity_vector(d, rows, cols, rules), naive_vector(d, rows, cols, rules));
  }
}

TEST(DisparityVector, Example) {
  EXPECT_EQ(disparity_vector(6, -1, 1, {64, 2, 16}), (MotionVector{2, -1}));
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

}  // namespace
}  // namespace hmlfc
