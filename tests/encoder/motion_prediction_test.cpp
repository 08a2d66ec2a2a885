// The encoder's predictions against the definition of MOT-9, one sample at a time.
#include "encoder/motion_prediction.hpp"

#include <random>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

constexpr int32_t kPlaneWidth = 13;
constexpr int32_t kPlaneHeight = 11;

int64_t sample_at(const SamplePlane& plane, int32_t x, int32_t y) {
  const int32_t column = x < 0 ? 0 : x >= kPlaneWidth ? kPlaneWidth - 1 : x;
  const int32_t row = y < 0 ? 0 : y >= kPlaneHeight ? kPlaneHeight - 1 : y;
  return plane.at(static_cast<uint32_t>(column), static_cast<uint32_t>(row));
}

// I(x, y) of MOT-9 as the sum over the four corners.
int64_t defined(const SamplePlane& plane, int32_t x, int32_t y, const SubpelVector& v) {
  int64_t sum = 0;
  for (int32_t j = 0; j < 2; ++j) {
    for (int32_t i = 0; i < 2; ++i) {
      const int64_t weight = (i == 0 ? 8 - v.fx : v.fx) * (j == 0 ? 8 - v.fy : v.fy);
      sum += weight * sample_at(plane, x + v.ix + i, y + v.iy + j);
    }
  }
  return sum;
}

TEST(MotionPrediction, EveryFractionNearTheBorders) {
  std::mt19937 random(1);
  SamplePlane plane(kPlaneWidth, kPlaneHeight);
  for (int16_t& sample : plane.samples) {
    sample = static_cast<int16_t>(static_cast<int32_t>(random() % 16381) - 8190);
  }
  const PaddedPlane padded(plane, kPlaneWidth, kPlaneHeight, 12);
  const Area area{4, 3, 8, 8};
  std::array<int32_t, 64> out{};
  std::array<int32_t, 64> combined{};
  for (int32_t ux = -80; ux <= 80; ++ux) {
    const int32_t uy = (ux * 37) % 70;
    const SubpelVector v = subpel_vector({ux, uy}, 3, false);
    interpolate(padded, area, v, out.data());
    combine(out.data(), nullptr, area.samples(), combined.data());
    for (int32_t k = 0; k < 64; ++k) {
      const int64_t expected = defined(plane, area.x + k % 8, area.y + k / 8, v);
      ASSERT_EQ(out[static_cast<size_t>(k)], expected) << ux << ", " << uy << " at " << k;
      ASSERT_EQ(combined[static_cast<size_t>(k)], (expected + 32) >> 6);
    }
  }
}

TEST(MotionPrediction, TwoReferencesAreRoundedOnce) {
  const std::array<int32_t, 4> first{64, 65, -64, -1};
  const std::array<int32_t, 4> second{0, 0, -1, 0};
  std::array<int32_t, 4> out{};
  combine(first.data(), second.data(), 4, out.data());
  EXPECT_EQ(out, (std::array<int32_t, 4>{1, 1, -1, 0}));
}

}  // namespace
}  // namespace hmlfc
