// The fast reader of sequences equals bise_value for every input.
#include "decoder/fast/bise_unpack.hpp"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"
#include "bits/bit_string.hpp"

namespace hmlfc {
namespace {

constexpr uint16_t kUntouched = 0xBEEF;

std::vector<uint16_t> unpack(std::vector<uint8_t> bytes, uint8_t slack, uint64_t start,
                             const Levels& levels, size_t count) {
  bytes.insert(bytes.end(), kBiseUnpackSlack, slack);
  std::vector<uint16_t> values(count + 1, kUntouched);
  bise_unpack(bytes.data(), start, levels, count, values.data());
  EXPECT_EQ(values.back(), kUntouched) << "writes past the last value";
  values.pop_back();
  return values;
}

std::vector<uint16_t> read_one_by_one(const std::vector<uint8_t>& bytes, uint64_t start,
                                      const Levels& levels, size_t count) {
  std::vector<uint16_t> values;
  for (size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<uint16_t>(bise_value(BitString(bytes), start, levels, count, i)));
  }
  return values;
}

// Reads bytes that end where the sequence ends: the slack after them must not matter.
void check(std::mt19937& random, const Levels& levels, size_t count, uint64_t start) {
  std::vector<uint8_t> bytes((start + bise_bits(levels, count) + 7) / 8);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
  const auto expected = read_one_by_one(bytes, start, levels, count);
  ASSERT_EQ(unpack(bytes, 0x00, start, levels, count), expected)
      << levels.count << " levels, " << count << " values at bit " << start;
  ASSERT_EQ(unpack(bytes, 0xFF, start, levels, count), expected)
      << levels.count << " levels, " << count << " values at bit " << start;
}

TEST(BiseUnpack, EveryLevelCountLengthAndBitOffset) {
  std::mt19937 random(1);
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    for (size_t count = 0; count <= 64; ++count) {
      for (uint64_t start = 0; start < 8; ++start) {
        check(random, levels_of_code(code), count, start);
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
