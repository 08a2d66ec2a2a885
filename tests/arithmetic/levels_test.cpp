// Level codes against the sorted list of level counts (BISE-1, BISE-2, TIL-8).
#include "arithmetic/bise.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/naive_bise.hpp"

namespace hmlfc {
namespace {

TEST(Levels, EveryCodeHasTheNextCountOfTheList) {
  const std::vector<uint32_t> counts = test::naive_level_counts();
  ASSERT_EQ(counts.size(), kMaxLevelCode + 1);
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    EXPECT_EQ(levels_of_code(code).count, counts[code]) << code;
  }
}

// BISE-1 as it is written, code by code.
TEST(Levels, FormulaOfTheSpecification) {
  EXPECT_EQ(levels_of_code(0).count, 1u);
  EXPECT_EQ(levels_of_code(1).count, 2u);
  EXPECT_EQ(levels_of_code(2).count, 3u);
  unsigned code = 3;
  for (uint32_t power = 1; code <= kMaxLevelCode; power *= 2) {
    for (const uint32_t factor : {4u, 5u, 6u}) {
      if (code <= kMaxLevelCode) {
        EXPECT_EQ(levels_of_code(code).count, factor * power) << code;
      }
      ++code;
    }
  }
}

TEST(Levels, CountIsDigitsTimesPlainValues) {
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    const uint32_t digits = levels.digit == Digit::kTrit    ? 3
                            : levels.digit == Digit::kQuint ? 5
                                                            : 1;
    EXPECT_EQ(digits << levels.plain_bits, levels.count) << code;
  }
}

TEST(Levels, LeastCodeForEveryCount) {
  const std::vector<uint32_t> counts = test::naive_level_counts();
  unsigned least = 0;
  for (uint32_t count = 1; count <= 16384; ++count) {
    if (counts[least] < count) ++least;
    ASSERT_EQ(level_code_for(count), least) << count;
  }
}

// TIL-8: 27 + 3 (depth - 8). Section 11: a BISE value is at most 4 * 2^n - 1.
TEST(Levels, GreatestResidualCodeOfEachDepth) {
  for (int depth = 8; depth <= 12; ++depth) {
    const unsigned code = max_residual_level_code(depth);
    EXPECT_EQ(code, static_cast<unsigned>(3 * depth + 3));
    EXPECT_EQ(levels_of_code(code).count, 4u << depth);
  }
  EXPECT_EQ(max_residual_level_code(12), kMaxLevelCode);
}

}  // namespace
}  // namespace hmlfc
