// Steps and residuals of steps (STP-2, STP-3).
#include "arithmetic/reconstruct.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/naive_bise.hpp"
#include "arithmetic/naive_integers.hpp"
#include "arithmetic/reconstruct.hpp"

namespace hmlfc {
namespace {

using test::between;

const std::vector<int32_t> kSteps{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256};

// All numbers 2^i and 3 * 2^i up to 256, ascending, are the list of STP-2.
TEST(Steps, EveryCode) {
  std::vector<int32_t> found;
  for (int32_t step = 1; step <= 256; ++step) {
    int32_t odd = step;
    while (odd % 2 == 0) odd /= 2;
    if (odd == 1 || odd == 3) found.push_back(step);
  }
  EXPECT_EQ(found, kSteps);
  ASSERT_EQ(kSteps.size(), kMaxStepCode + 1);
  for (unsigned code = 0; code <= kMaxStepCode; ++code) {
    EXPECT_EQ(step_of_code(code), kSteps[code]) << code;
  }
}

TEST(Steps, StepOneIsTheResidualOfMain) {
  for (const Plane plane : {Plane::kY, Plane::kCo}) {
    const SampleRange range = sample_range(plane, 8);
    for (const uint32_t levels : test::naive_level_counts()) {
      if (levels > 1024) break;
      for (uint32_t value = 0; value < levels; ++value) {
        for (const int32_t bias : {-512, -3, 0, 1, 511}) {
          ASSERT_EQ(stepped_residual(value, levels, bias, 1, range),
                    residual_of_value(value, levels, bias, range));
        }
      }
    }
  }
}

// STP-3 in 64 bits, all values of each level count, every step, biases at their ends.
void check_depth(int depth, const std::vector<uint32_t>& level_counts) {
  for (const Plane plane : {Plane::kY, Plane::kCg}) {
    const SampleRange range = sample_range(plane, depth);
    const int64_t bound = range.hi - range.lo;
    const int32_t half = 1 << (depth + 1);
    for (const uint32_t levels : level_counts) {
      for (uint32_t value = 0; value<levels; value += levels> 64 ? 7 : 1) {
        for (const int32_t bias : {-half, -half + 1, -17, -1, 0, 1, 30, half - 1}) {
          for (const int32_t step : kSteps) {
            const int64_t coded = between(-bound, int64_t{value} - levels / 2 + bias, bound);
            ASSERT_EQ(stepped_residual(value, levels, bias, step, range),
                      between(-bound, step * coded, bound))
                << "value " << value << " of " << levels << ", bias " << bias << ", step " << step;
          }
        }
      }
    }
  }
}

TEST(Steps, ResidualsOfEveryDepth) {
  for (int depth = 8; depth <= 12; ++depth) check_depth(depth, {1, 2, 3, 40, 1u << (depth + 2)});
}

// The greatest product before the outer clamp: 256 * M (section 11).
TEST(Steps, ExtremesAreClamped) {
  const SampleRange range = sample_range(Plane::kCo, 12);
  EXPECT_EQ(stepped_residual(16383, 16384, 8191, 256, range), 8190);
  EXPECT_EQ(stepped_residual(0, 16384, -8192, 256, range), -8190);
  EXPECT_EQ(stepped_residual(0, 40, 3, 4, sample_range(Plane::kY, 8)), -68);
}

}  // namespace
}  // namespace hmlfc
