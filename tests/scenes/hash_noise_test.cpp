#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/hash_noise.hpp"

namespace hmlfc::scenes {
namespace {

TEST(HashNoise, MixBitsIsSplitMix64) {
  // The first outputs of the published generator for the seed 1234567.
  uint64_t state = 1234567;
  for (const uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                  4593380528125082431u, 16408922859458223821u}) {
    EXPECT_EQ(mix_bits(state), expected);
    state += 0x9E3779B97F4A7C15u;
  }
}

TEST(HashNoise, FloorsGoDownwards) {
  EXPECT_EQ(floor_to_int(2.75), 2);
  EXPECT_EQ(floor_to_int(-2.75), -3);
  EXPECT_EQ(floor_to_int(-3.0), -3);
  EXPECT_EQ(floor_to_int(0.0), 0);
  EXPECT_EQ(fraction(-0.25), 0.75);
}

TEST(HashNoise, StreamsAreUniformAndKeepTheirInterval) {
  HashStream random(1, 2);
  std::array<int, 6> counts = {};
  double sum = 0;
  for (int i = 0; i < 60000; ++i) {
    ++counts[random.below(6)];
    const double value = random.uniform(-3, 5);
    ASSERT_GE(value, -3);
    ASSERT_LT(value, 5);
    sum += value;
  }
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
  EXPECT_NEAR(sum / 60000, 1.0, 0.05);
  EXPECT_NE(HashStream(1, 2).next(), HashStream(1, 3).next());
  EXPECT_NE(HashStream(1, 2).next(), HashStream(2, 2).next());
}

TEST(HashNoise, ValueNoiseIsContinuousAndMeetsItsCells) {
  for (int64_t y = -3; y < 3; ++y) {
    for (int64_t x = -3; x < 3; ++x) {
      const auto at_x = static_cast<double>(x);
      const auto at_y = static_cast<double>(y);
      EXPECT_EQ(value_noise(9, at_x, at_y), cell_noise(9, x, y));
      EXPECT_NEAR(value_noise(9, at_x - 1e-7, at_y - 1e-7), cell_noise(9, x, y), 1e-6);
    }
  }
  for (int i = 0; i < 1000; ++i) {
    const double layers = layered_noise(3, 0.37 * i, -0.61 * i, 4);
    EXPECT_GE(layers, 0.0);
    EXPECT_LE(layers, 1.0);
  }
}

}  // namespace
}  // namespace hmlfc::scenes
