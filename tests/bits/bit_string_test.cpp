// BitString and BitWriter against a vector of bools (CNV-4, CNV-5).
#include "bits/bit_string.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bits/bit_string.hpp"
#include "bits/naive_bits.hpp"

namespace hmlfc {
namespace {

using test::NaiveBits;

uint32_t low_bits(uint32_t value, unsigned count) {
  return static_cast<uint32_t>(value % (uint64_t{1} << count));
}

struct Field {
  uint32_t value;
  unsigned count;
};

std::vector<Field> draw_fields() {
  std::vector<Field> fields;
  for (const uint32_t value : *rc::gen::arbitrary<std::vector<uint32_t>>()) {
    // Small arbitrary integers would leave the high bits 0.
    const uint32_t wide = value * 0x9E3779B1u;
    const unsigned count = *rc::gen::inRange(0u, 33u);
    fields.push_back({low_bits(wide, count), count});
  }
  return fields;
}

TEST(BitString, EveryPositionAndLengthOfSevenBytes) {
  const std::vector<uint8_t> bytes{0xB4, 0x01, 0xFF, 0x00, 0x5A, 0xC3, 0x97};
  const NaiveBits naive(bytes);
  const BitString bits(bytes);
  ASSERT_EQ(bits.size(), 56u);
  for (unsigned position = 0; position <= 56; ++position) {
    for (unsigned count = 0; count <= 32 && position + count <= 56; ++count) {
      ASSERT_EQ(bits.field(position, count), naive.field(position, count))
          << count << " bits at " << position;
    }
  }
}

TEST(BitString, HoldsExactlyWhatEndsWithinIt) {
  const std::vector<uint8_t> bytes(3);
  const BitString bits(bytes);
  for (uint64_t position = 0; position <= 30; ++position) {
    for (uint64_t count = 0; count <= 30; ++count) {
      EXPECT_EQ(bits.holds(position, count), position + count <= 24) << position << " " << count;
    }
  }
  const uint64_t most = std::numeric_limits<uint64_t>::max();
  EXPECT_FALSE(bits.holds(most, 0));
  EXPECT_FALSE(bits.holds(most, most));
  EXPECT_FALSE(bits.holds(8, most - 7)) << "8 + (2^64 - 8) wraps to 0";
  EXPECT_FALSE(bits.holds(most - 7, 8));
}

TEST(BitWriter, EveryLengthAfterEveryOffset) {
  for (unsigned offset = 0; offset < 8; ++offset) {
    for (unsigned count = 0; count <= 32; ++count) {
      for (const uint32_t pattern : {0u, 0xFFFFFFFFu, 0xA5C3F00Fu, 0x80000001u}) {
        const uint32_t value = low_bits(pattern, count);
        NaiveBits naive;
        naive.put(1, offset).put(value, count).put(1, 1);
        BitWriter writer;
        writer.put(offset > 0 ? 1 : 0, offset);
        writer.put(value, count);
        writer.put(1, 1);
        ASSERT_EQ(writer.size(), naive.size());
        ASSERT_EQ(writer.bytes(), naive.bytes()) << count << " bits at " << offset;
      }
    }
  }
}

TEST(BitWriter, SignedFieldsAreTwosComplement) {
  for (unsigned count = 0; count <= 9; ++count) {
    const int32_t half = count == 0 ? 0 : 1 << (count - 1);
    for (int32_t value = -half; value < std::max(half, 1); ++value) {
      NaiveBits naive;
      naive.put(5, 3).put_signed(value, count);
      BitWriter writer;
      writer.put(5, 3);
      writer.put_signed(value, count);
      ASSERT_EQ(writer.size(), 3 + count);
      ASSERT_EQ(writer.bytes(), naive.bytes()) << value << " in " << count;
    }
  }
  BitWriter writer;
  writer.put_signed(std::numeric_limits<int32_t>::min(), 32);
  EXPECT_EQ(writer.bytes(), (std::vector<uint8_t>{0, 0, 0, 0x80}));
}

TEST(BitWriter, TakeLeavesAnEmptyWriter) {
  BitWriter writer;
  writer.put(0x1FF, 9);
  EXPECT_EQ(writer.take(), (std::vector<uint8_t>{0xFF, 0x01}));
  EXPECT_EQ(writer.size(), 0u);
  EXPECT_TRUE(writer.bytes().empty());
  writer.put(1, 1);
  EXPECT_EQ(writer.bytes(), std::vector<uint8_t>{1});
}

RC_GTEST_PROP(BitWriter, WritesWhatTheNaiveModelWrites, ()) {
  NaiveBits naive;
  BitWriter writer;
  for (const Field& field : draw_fields()) {
    naive.put(field.value, field.count);
    writer.put(field.value, field.count);
  }
  RC_ASSERT(writer.size() == naive.size());
  RC_ASSERT(writer.bytes() == naive.bytes());
}

RC_GTEST_PROP(BitString, ReadsWhatTheNaiveModelReads, (const std::vector<uint8_t>& bytes)) {
  const NaiveBits naive(bytes);
  const BitString bits(bytes);
  const uint64_t position = *rc::gen::inRange<uint64_t>(0, bits.size() + 1);
  const auto most = static_cast<unsigned>(std::min<uint64_t>(32, bits.size() - position));
  const unsigned count = *rc::gen::inRange(0u, most + 1);
  RC_ASSERT(bits.field(position, count) == naive.field(position, count));
}

}  // namespace
}  // namespace hmlfc
