// Little-endian integers, masks and ranks (CNV-3, CNV-6).
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bits/bit_string.hpp"
#include "bits/little_endian.hpp"
#include "bits/naive_bits.hpp"

namespace hmlfc {
namespace {

using test::NaiveBits;

template <class T>
void check_every_offset() {
  const std::vector<uint8_t> bytes{0x01, 0x80, 0xFE, 0x7F, 0x00, 0xFF, 0xC4, 0x3B, 0x99, 0x02};
  const NaiveBits naive{std::span(bytes)};
  for (size_t offset = 0; offset + sizeof(T) <= bytes.size(); ++offset) {
    EXPECT_EQ(load_le<T>(bytes, offset), naive.field(offset * 8, sizeof(T) * 8)) << offset;
  }
}

template <class T>
void check_append(T value) {
  std::vector<uint8_t> bytes{0xAA};
  append_le(bytes, value);
  NaiveBits naive;
  naive.put(0xAA, 8).put(value, sizeof(T) * 8);
  RC_ASSERT(bytes == naive.bytes());
  RC_ASSERT(load_le<T>(bytes, 1) == value);
}

TEST(LittleEndian, EveryOffset) {
  check_every_offset<uint8_t>();
  check_every_offset<uint16_t>();
  check_every_offset<uint32_t>();
  check_every_offset<uint64_t>();
}

RC_GTEST_PROP(LittleEndian, AppendedBytesLoadBack, (uint64_t seed)) {
  const uint64_t value = seed * 0x9E3779B97F4A7C15u;
  check_append(static_cast<uint8_t>(value));
  check_append(static_cast<uint16_t>(value));
  check_append(static_cast<uint32_t>(value));
  check_append(value);
}

TEST(BitMask, EachBitAndEachPrefix) {
  for (const uint64_t mask : {uint64_t{0}, ~uint64_t{0}, uint64_t{1}, uint64_t{1} << 63,
                              uint64_t{0xA5A5A5A5A5A5A5A5}, uint64_t{0x0123456789ABCDEF}}) {
    NaiveBits naive;
    naive.put(mask, 64);
    unsigned below = 0;
    for (unsigned i = 0; i < 64; ++i) {
      EXPECT_EQ(has_bit(mask, i), naive[i]) << mask << " " << i;
      EXPECT_EQ(rank(mask, i), below) << mask << " " << i;
      below += naive[i] ? 1u : 0u;
    }
  }
}

}  // namespace
}  // namespace hmlfc
