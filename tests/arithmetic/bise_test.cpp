// Level codes against the sorted list of level counts, and sequences of every level count against
// the naive coder (BISE-1 to BISE-7, BISE-10, BISE-11, TIL-8).
#include "arithmetic/bise.hpp"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "arithmetic/naive_bise.hpp"
#include "bits/naive_bits.hpp"

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

using test::NaiveBits;
using Values = std::vector<uint32_t>;

Values draw_values(std::mt19937& random, uint32_t N, size_t count) {
  Values values(count);
  for (uint32_t& value : values) value = std::uniform_int_distribution(0u, N - 1)(random);
  return values;
}

Values read_all(const std::vector<uint8_t>& bytes, uint64_t start, const Levels& levels,
                uint64_t count) {
  const BitString bits(bytes);
  Values values;
  for (uint64_t i = 0; i < count; ++i) {
    values.push_back(bise_value(bits, start, levels, count, i));
  }
  return values;
}

// Writes `values` after `before` bits of 1 and expects the naive coder's bits; then reads them.
void check_round_trip(const Levels& levels, const Values& values, unsigned before) {
  NaiveBits naive;
  naive.put(0xFFFF, before);
  test::naive_bise_encode(naive, levels.count, values);
  BitWriter writer;
  writer.put((1u << before) - 1, before);
  bise_put(writer, levels, values);
  ASSERT_EQ(writer.size(), naive.size()) << levels.count;
  ASSERT_EQ(writer.bytes(), naive.bytes()) << levels.count;
  ASSERT_EQ(writer.size(), before + bise_bits(levels, values.size()));
  ASSERT_EQ(read_all(writer.bytes(), before, levels, values.size()), values) << levels.count;
}

TEST(Bise, SizeOfEverySequenceUpTo200) {
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    for (uint64_t count = 0; count <= 200; ++count) {
      ASSERT_EQ(bise_bits(levels, count), test::naive_bise_bits(levels.count, count));
    }
  }
}

TEST(Bise, SizesSpelledOut) {
  EXPECT_EQ(bise_bits(levels_of_code(8), 16), 58u) << "12 levels: 2 * 16 + ceil(128 / 5)";
  EXPECT_EQ(bise_bits(levels_of_code(27), 64), 640u) << "1024 levels";
  EXPECT_EQ(bise_bits(levels_of_code(4), 4), 10u) << "5 levels: ceil(28 / 3)";
  EXPECT_EQ(bise_bits(levels_of_code(0), 64), 0u) << "1 level takes no bits";
}

// Each value of each level count stands at each place of a group.
TEST(Bise, EveryLevelCountTimesEveryValue) {
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    const size_t members = levels.digit == Digit::kTrit    ? kTritsPerGroup
                           : levels.digit == Digit::kQuint ? kQuintsPerGroup
                                                           : 1;
    for (size_t place = 0; place < members; ++place) {
      Values values(place, levels.count - 1);
      for (uint32_t value = 0; value < levels.count; ++value) values.push_back(value);
      BitWriter writer;
      bise_put(writer, levels, values);
      ASSERT_EQ(read_all(writer.bytes(), 0, levels, values.size()), values) << levels.count;
    }
  }
}

TEST(Bise, EveryTailLengthOfEveryLevelCount) {
  std::mt19937 random(1);
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    for (size_t count = 0; count <= 11; ++count) {
      check_round_trip(levels, Values(count, 0), 0);
      check_round_trip(levels, Values(count, levels.count - 1), 3);
      for (unsigned before = 0; before < 8; ++before) {
        check_round_trip(levels, draw_values(random, levels.count, count), before);
      }
    }
  }
}

// All digit tuples of every cut group: the canonical code needs no bit that is cut off.
TEST(Bise, EveryDigitTupleOfEveryTail) {
  for (const unsigned code : {2u, 4u}) {
    const Levels levels = levels_of_code(code);
    const size_t members = code == 2 ? kTritsPerGroup : kQuintsPerGroup;
    size_t tuples = 1;
    for (size_t count = 1; count <= members; ++count) {
      tuples *= levels.count;
      for (size_t tuple = 0; tuple < tuples; ++tuple) {
        Values values;
        for (size_t left = tuple; values.size() < count; left /= levels.count) {
          values.push_back(static_cast<uint32_t>(left % levels.count));
        }
        check_round_trip(levels, values, 0);
      }
    }
  }
}

// Any bit pattern is a sequence (BISE-10): redundant codes and cut groups included.
TEST(Bise, ReadsEveryBitPatternAsTheNaiveDecoder) {
  std::mt19937 random(2);
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    for (size_t count = 0; count <= 64; ++count) {
      std::vector<uint8_t> bytes((bise_bits(levels, count) + 14) / 8);
      for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
      const unsigned start = static_cast<unsigned>(count % 8);
      ASSERT_EQ(read_all(bytes, start, levels, count),
                test::naive_bise_decode(NaiveBits(bytes), start, levels.count, count))
          << levels.count << " levels, " << count << " values";
    }
  }
}

// What follows a cut group is another field: its bits do not matter.
TEST(Bise, BitsBehindACutGroupDoNotMatter) {
  std::mt19937 random(3);
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    for (size_t count = 1; count <= 11; ++count) {
      const Values values = draw_values(random, levels.count, count);
      for (const uint32_t behind : {0u, 0xFFFFu}) {
        BitWriter writer;
        bise_put(writer, levels, values);
        writer.put(behind, 16);
        ASSERT_EQ(read_all(writer.bytes(), 0, levels, count), values) << levels.count;
      }
    }
  }
}

RC_GTEST_PROP(Bise, RoundTrip, ()) {
  const unsigned code = *rc::gen::inRange(0u, kMaxLevelCode + 1);
  const Levels levels = levels_of_code(code);
  const auto values = *rc::gen::container<Values>(rc::gen::inRange<uint32_t>(0, levels.count));
  const unsigned before = *rc::gen::inRange(0u, 8u);
  BitWriter writer;
  writer.put(0, before);
  bise_put(writer, levels, values);
  RC_ASSERT(read_all(writer.bytes(), before, levels, values.size()) == values);
  RC_ASSERT(test::naive_bise_decode(NaiveBits(writer.bytes()), before, levels.count,
                                    values.size()) == values);
}

}  // namespace
}  // namespace hmlfc
