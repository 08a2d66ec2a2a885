// The arithmetic of one sample against its formulas in 64 bits (TIL-10, STP-2, STP-3, DEC-3).
#include "arithmetic/reconstruct.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"
#include "arithmetic/naive_integers.hpp"

namespace hmlfc {
namespace {

using test::between;

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

// Every value of every level count that the depth allows, with each of `biases`.
void check_residuals(Plane plane, int depth, const std::vector<int32_t>& biases) {
  const SampleRange range = sample_range(plane, depth);
  for (unsigned code = 0; code <= max_residual_level_code(depth); ++code) {
    const uint32_t levels = levels_of_code(code).count;
    for (const int32_t bias : biases) {
      for (uint32_t value = 0; value < levels; ++value) {
        ASSERT_EQ(residual_of_value(value, levels, bias, range),
                  between(-range.bound, int64_t{value} - levels / 2 + bias, range.bound))
            << value << " of " << levels << ", bias " << bias;
      }
    }
  }
}

TEST(Reconstruct, AllResidualsOfDepth8) {
  for (const Plane plane : {Plane::kY, Plane::kCo}) check_residuals(plane, 8, all(-512, 511));
}

TEST(Reconstruct, BoundaryResidualsOfEveryDepth) {
  for (int depth = 9; depth <= 12; ++depth) {
    for (const Plane plane : kPlanes) {
      check_residuals(plane, depth, boundaries(-(2 << depth), (2 << depth) - 1));
    }
  }
}

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

}  // namespace
}  // namespace hmlfc
