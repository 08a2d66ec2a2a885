// The encoder's predictions against the definition of MOT-9, one sample at a time.
#include "encoder/motion_prediction.hpp"

#include <random>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

constexpr int32_t kPlaneWidth = 13;
constexpr int32_t kPlaneHeight = 11;
constexpr int32_t kBound = 8190;

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
    sample = static_cast<int16_t>(static_cast<int32_t>(random() % (2 * kBound + 1)) - kBound);
  }
  const PaddedPlane padded(plane, kPlaneWidth, kPlaneHeight, 12);
  constexpr int32_t kX = 4;
  constexpr int32_t kY = 3;
  std::array<int16_t, 64> out{};
  for (int32_t ux = -80; ux <= 80; ++ux) {
    const SubpelVector v = subpel_vector({ux, (ux * 37) % 70}, 3, false);
    const SubpelVector w = subpel_vector({-ux, (ux * 11) % 70}, 3, false);
    for (const unsigned count : {1u, 2u}) {
      interpolate_rect({displaced(padded, kX, kY, v), displaced(padded, kX, kY, w)}, count, kBound,
                       {out.data(), 8, 8, 8});
      for (int32_t k = 0; k < 64; ++k) {
        const int32_t x = kX + k % 8;
        const int32_t y = kY + k / 8;
        const int64_t one = (defined(plane, x, y, v) + 32) >> 6;
        const int64_t two = (defined(plane, x, y, v) + defined(plane, x, y, w) + 64) >> 7;
        ASSERT_EQ(out[static_cast<size_t>(k)], count == 1 ? one : two) << ux << " at " << k;
      }
    }
  }
}

TEST(MotionPrediction, TheBoundOfReferencesIsTheirRange) {
  EXPECT_EQ(reference_bound(Plane::kY, 8, true), 255);
  EXPECT_EQ(reference_bound(Plane::kCo, 8, true), 255);
  EXPECT_EQ(reference_bound(Plane::kCo, 8, false), 510);
  EXPECT_EQ(reference_bound(Plane::kCg, 12, false), 8190);
}

}  // namespace
}  // namespace hmlfc
