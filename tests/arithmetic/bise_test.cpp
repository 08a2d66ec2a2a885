// Level codes, and sequences of every level count read back (BISE-1 to BISE-7, BISE-10, BISE-11,
// TIL-8). What the bits of a sequence mean, the vectors and the decoder in Python say.
#include "arithmetic/bise.hpp"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "bits/bit_string.hpp"

namespace hmlfc {
namespace {

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

TEST(Levels, LeastCodeForEveryCount) {
  unsigned least = 0;
  for (uint32_t count = 1; count <= 16384; ++count) {
    if (levels_of_code(least).count < count) ++least;
    ASSERT_EQ(level_code_for(count), least) << count;
  }
}

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

// Writes `values` after `before` bits of 1 and before others; then reads them.
void check_round_trip(const Levels& levels, const Values& values, unsigned before) {
  for (const uint32_t after : {0u, 0xFFFFu}) {
    BitWriter writer;
    writer.put((1u << before) - 1, before);
    bise_put(writer, levels, values);
    ASSERT_EQ(writer.size(), before + bise_bits(levels, values.size()));
    writer.put(after, 16);
    ASSERT_EQ(read_all(writer.bytes(), before, levels, values.size()), values) << levels.count;
  }
}

TEST(Bise, SizeOfEverySequenceUpTo200) {
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    for (uint64_t count = 0; count <= 200; ++count) {
      uint64_t bits = levels.plain_bits * count;
      if (levels.digit == Digit::kTrit) bits += (8 * count + 4) / 5;
      if (levels.digit == Digit::kQuint) bits += (7 * count + 2) / 3;
      ASSERT_EQ(bise_bits(levels, count), bits) << levels.count;
    }
  }
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

}  // namespace
}  // namespace hmlfc
