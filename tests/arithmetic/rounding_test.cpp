// Every rounding helper against a formula of its own (CNV-1, CNV-2, CNV-5, MOT-8).
#include "arithmetic/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

constexpr int32_t kLeast = std::numeric_limits<int32_t>::min();
constexpr int32_t kMost = std::numeric_limits<int32_t>::max();

// The floor of x / 2^k: exact in double, which has 53 bits.
int32_t floor_by_double(int32_t x, int k) {
  return static_cast<int32_t>(std::floor(static_cast<double>(x) / std::exp2(k)));
}

TEST(FloorShift, EveryValueOfSeventeenBits) {
  for (int k = 0; k <= 18; ++k) {
    for (int32_t x = -65536; x <= 65536; ++x) {
      ASSERT_EQ(floor_shift(x, k), floor_by_double(x, k)) << x << " >> " << k;
    }
  }
}

TEST(FloorShift, ExtremesAndEveryShift) {
  for (int k = 0; k <= 30; ++k) {
    for (const int32_t x : {kLeast, kLeast + 1, -(1 << k), -(1 << k) - 1, -(1 << k) + 1, -1, 0, 1,
                            (1 << k) - 1, 1 << k, kMost - 1, kMost}) {
      ASSERT_EQ(floor_shift(x, k), floor_by_double(x, k)) << x << " >> " << k;
    }
  }
  EXPECT_EQ(floor_shift(-3, 1), -2);
}

// rshift of MOT-8: the nearest integer, halves up.
TEST(RoundShift, EveryValueOfSeventeenBits) {
  for (unsigned k = 0; k <= 9; ++k) {
    for (int32_t x = -65536; x <= 65536; ++x) {
      const double nearest = std::floor(static_cast<double>(x) / std::exp2(k) + 0.5);
      ASSERT_EQ(round_shift(x, k), static_cast<int32_t>(nearest)) << x << ", " << k;
    }
  }
}

// The smallest q with q * y >= x.
TEST(CeilDiv, EveryPairBelow400) {
  for (uint32_t y = 1; y < 400; ++y) {
    uint32_t q = 0;
    for (uint32_t x = 0; x < 400; ++x) {
      if (q * y < x) ++q;
      ASSERT_EQ(ceil_div(x, y), q) << x << " / " << y;
    }
  }
}

TEST(CeilDiv, DoesNotWrapAtTheEndOfItsType) {
  EXPECT_EQ(ceil_div(0xFFFFFFFFu, 2u), 0x80000000u);
  EXPECT_EQ(ceil_div(0xFFFFFFFFu, 1u), 0xFFFFFFFFu);
  EXPECT_EQ(ceil_div(0xFFFFFFFFu, 0xFFFFFFFFu), 1u);
  EXPECT_EQ(ceil_div(~uint64_t{0}, uint64_t{64}), uint64_t{1} << 58);
  EXPECT_EQ(ceil_div(uint8_t{255}, uint8_t{2}), 128);
}

// The middle one of three numbers.
TEST(Clamp, EveryTripleOfASmallCube) {
  for (int32_t lo = -20; lo <= 20; ++lo) {
    for (int32_t hi = lo; hi <= 20; ++hi) {
      for (int32_t x = -25; x <= 25; ++x) {
        int32_t three[] = {lo, x, hi};
        std::sort(std::begin(three), std::end(three));
        ASSERT_EQ(clamp(x, lo, hi), three[1]) << x << " in [" << lo << ", " << hi << "]";
      }
    }
  }
}

// Two's complement as a sum: the highest bit weighs -2^(bits - 1), bit i below it 2^i.
int32_t weighed(uint32_t field, unsigned bits) {
  int64_t sum = 0;
  for (unsigned i = 0; i < bits; ++i) {
    const int64_t weight = i + 1 == bits ? -(int64_t{1} << i) : int64_t{1} << i;
    if ((field >> i) % 2 != 0) sum += weight;
  }
  return static_cast<int32_t>(sum);
}

TEST(SignExtend, EveryFieldUpToSixteenBits) {
  for (unsigned bits = 0; bits <= 16; ++bits) {
    for (uint32_t field = 0; field < (1u << bits); ++field) {
      ASSERT_EQ(sign_extend(field, bits), weighed(field, bits)) << field << " in " << bits;
    }
  }
}

TEST(SignExtend, IgnoresBitsAboveTheField) {
  for (unsigned bits = 0; bits <= 31; ++bits) {
    for (const uint32_t field : {0u, 1u, 0x2AAAAAAAu, 0x55555555u, 0x80000000u, 0xFFFFFFFFu}) {
      ASSERT_EQ(sign_extend(field, bits), weighed(field, bits)) << field << " in " << bits;
    }
  }
}

// The integer r with r - 1/2 <= sum / count < r + 1/2.
bool is_nearest_half_up(int64_t r, int64_t sum, int64_t count) {
  return (2 * r - 1) * count <= 2 * sum && 2 * sum < (2 * r + 1) * count;
}

TEST(RoundHalfUpDiv, EverySumAndCount) {
  for (int64_t count = 1; count <= 256; ++count) {
    for (int64_t sum = -4 * count - 300; sum <= 4 * count + 300; ++sum) {
      ASSERT_TRUE(is_nearest_half_up(round_half_up_div(sum, count), sum, count))
          << sum << " / " << count;
    }
  }
}

}  // namespace
}  // namespace hmlfc
