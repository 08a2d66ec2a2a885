// The arithmetic of one sample against its formulas in 64 bits (TIL-10, DEC-3).
#include "arithmetic/reconstruct.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/naive_bise.hpp"

namespace hmlfc {
namespace {

int64_t between(int64_t lo, int64_t x, int64_t hi) { return std::max(lo, std::min(x, hi)); }

int64_t naive_residual(int64_t value, int64_t levels, int64_t bias, int64_t bound) {
  return between(-bound, value - levels / 2 + bias, bound);
}

// The least, the greatest and what lies around 0 and around each end of [lo, hi].
std::vector<int32_t> boundaries(int32_t lo, int32_t hi) {
  std::vector<int32_t> values{lo, lo + 1, lo + 2, lo / 2, -2,     -1, 0,
                              1,  2,      hi / 2, hi - 2, hi - 1, hi};
  std::erase_if(values, [&](int32_t x) { return x < lo || x > hi; });
  return values;
}

std::vector<int32_t> all(int32_t lo, int32_t hi) {
  std::vector<int32_t> values;
  for (int32_t x = lo; x <= hi; ++x) values.push_back(x);
  return values;
}

void check_sums(const SampleRange& range, const std::vector<int32_t>& samples,
                const std::vector<int32_t>& residuals) {
  for (const int32_t sample : samples) {
    for (const int32_t residual : residuals) {
      const int64_t a = sample;
      const int64_t b = residual;
      ASSERT_EQ(motion_prediction(sample, false, residual, range),
                between(range.lo, a + b, range.hi));
      ASSERT_EQ(motion_prediction(sample, true, residual, range),
                between(range.lo, a - b, range.hi));
      ASSERT_EQ(add_residual(sample, residual, range), between(range.lo, a + b, range.hi));
    }
  }
}

TEST(Reconstruct, AllSumsOfDepth8) {
  for (const Plane plane : {Plane::kY, Plane::kCo}) {
    const SampleRange range = sample_range(plane, 8);
    check_sums(range, all(range.lo, range.hi), all(-range.bound, range.bound));
  }
}

TEST(Reconstruct, BoundarySumsOfEveryDepth) {
  for (int depth = 8; depth <= 12; ++depth) {
    for (const Plane plane : kPlanes) {
      const SampleRange range = sample_range(plane, depth);
      check_sums(range, boundaries(range.lo, range.hi), all(-range.bound, range.bound));
      check_sums(range, all(range.lo, range.hi), boundaries(-range.bound, range.bound));
    }
  }
}

// Every value of every level count that depth 8 allows, with every bias.
TEST(Reconstruct, AllResidualsOfDepth8) {
  for (const Plane plane : {Plane::kY, Plane::kCo}) {
    const SampleRange range = sample_range(plane, 8);
    for (const uint32_t levels : test::naive_level_counts()) {
      if (levels > 1024) continue;
      for (int32_t bias = -512; bias <= 511; ++bias) {
        for (uint32_t value = 0; value < levels; ++value) {
          ASSERT_EQ(residual_of_value(value, levels, bias, range),
                    naive_residual(value, levels, bias, range.bound))
              << value << " of " << levels << ", bias " << bias;
        }
      }
    }
  }
}

TEST(Reconstruct, BoundaryResidualsOfEveryDepth) {
  for (int depth = 9; depth <= 12; ++depth) {
    for (const Plane plane : kPlanes) {
      const SampleRange range = sample_range(plane, depth);
      for (const uint32_t levels : test::naive_level_counts()) {
        if (levels > (4u << depth)) continue;
        for (const int32_t bias : boundaries(-(2 << depth), (2 << depth) - 1)) {
          for (uint32_t value = 0; value < levels; ++value) {
            ASSERT_EQ(residual_of_value(value, levels, bias, range),
                      naive_residual(value, levels, bias, range.bound))
                << value << " of " << levels << ", bias " << bias;
          }
        }
      }
    }
  }
}

TEST(Reconstruct, ExamplesByHand) {
  const SampleRange y = sample_range(Plane::kY, 8);
  EXPECT_EQ(residual_of_value(0, 40, 3, y), -17) << "0 - 20 + 3";
  EXPECT_EQ(residual_of_value(0, 1, -300, y), -255) << "clamped to -M";
  EXPECT_EQ(residual_of_value(2, 3, 0, y), 1) << "2 - 1: odd counts have their middle at 0";
  EXPECT_EQ(motion_prediction(0, true, 7, y), 0) << "0 - 7 is below lo";
  EXPECT_EQ(motion_prediction(250, false, 7, y), 255);
  EXPECT_EQ(add_residual(10, -10, y), 0);
  const SampleRange co = sample_range(Plane::kCo, 8);
  EXPECT_EQ(motion_prediction(-250, true, 510, co), -255);
  EXPECT_EQ(add_residual(255, -510, co), -255) << "M reaches from one end to the other";
}

}  // namespace
}  // namespace hmlfc
