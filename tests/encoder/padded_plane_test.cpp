#include "encoder/padded_plane.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

struct Shape {
  uint32_t width;
  uint32_t height;
  int max_window;
};

std::vector<int16_t> random_samples(const Shape& shape, int amplitude) {
  std::mt19937 random(shape.width * 1000 + shape.height);
  std::uniform_int_distribution<int> value(-amplitude, amplitude);
  std::vector<int16_t> samples(size_t{shape.width} * shape.height);
  std::generate(samples.begin(), samples.end(),
                [&] { return static_cast<int16_t>(value(random)); });
  return samples;
}

class ReferencePlaneShapes : public testing::TestWithParam<Shape> {
 protected:
  // The value of a position inside or outside the plane, straight from the definition.
  int nearest(const std::vector<int16_t>& samples, int x, int y) const {
    const int last_x = static_cast<int>(GetParam().width) - 1;
    const int last_y = static_cast<int>(GetParam().height) - 1;
    const int row = y < 0 ? 0 : (y > last_y ? last_y : y);
    const int col = x < 0 ? 0 : (x > last_x ? last_x : x);
    return samples[static_cast<size_t>(row * (last_x + 1) + col)];
  }
};

TEST_P(ReferencePlaneShapes, PositionsOutsideHaveTheNearestSample) {
  const Shape& shape = GetParam();
  const std::vector<int16_t> samples = random_samples(shape, 16382);
  const ReferencePlane plane(samples, shape.width, shape.height, shape.max_window);
  for (int y = -shape.max_window; y <= static_cast<int>(shape.height) + shape.max_window + 6; ++y) {
    for (int x = -shape.max_window; x <= static_cast<int>(shape.width) + shape.max_window + 6;
         ++x) {
      ASSERT_EQ(*plane.sample(x, y), nearest(samples, x, y)) << "x " << x << " y " << y;
    }
  }
}

TEST_P(ReferencePlaneShapes, SquareSumsAddFourNeighbours) {
  const Shape& shape = GetParam();
  const std::vector<int16_t> samples = random_samples(shape, 8191);
  const ReferencePlane plane(samples, shape.width, shape.height, shape.max_window);
  for (int y = -shape.max_window; y <= static_cast<int>(shape.height) + shape.max_window + 5; ++y) {
    for (int x = -shape.max_window; x <= static_cast<int>(shape.width) + shape.max_window + 5;
         ++x) {
      const int sum = nearest(samples, x, y) + nearest(samples, x + 1, y) +
                      nearest(samples, x, y + 1) + nearest(samples, x + 1, y + 1);
      ASSERT_EQ(*plane.square_sum(x, y), sum) << "x " << x << " y " << y;
    }
  }
}

std::string shape_name(const testing::TestParamInfo<Shape>& shape) {
  return std::to_string(shape.param.width) + "x" + std::to_string(shape.param.height) + "window" +
         std::to_string(shape.param.max_window);
}

INSTANTIATE_TEST_SUITE_P(All, ReferencePlaneShapes,
                         testing::Values(Shape{1, 1, 0}, Shape{1, 1, 127}, Shape{3, 2, 16},
                                         Shape{2, 9, 5}, Shape{64, 32, 16}, Shape{33, 47, 33}),
                         shape_name);

TEST(ReferencePlane, KnowsItsShape) {
  const std::vector<int16_t> samples{3, -700, 699, 0, 1, 2};
  const ReferencePlane plane(samples, 3, 2, 4);
  EXPECT_EQ(plane.width(), 3U);
  EXPECT_EQ(plane.height(), 2U);
  EXPECT_EQ(plane.max_window(), 4);
  EXPECT_EQ(plane.sample(0, 1) - plane.sample(0, 0), plane.stride());
}

TEST(ReferencePlane, SquareSumsAreModulo16Bits) {
  EXPECT_EQ(*ReferencePlane(std::vector<int16_t>(4, -8192), 2, 2, 1).square_sum(0, 0), -32768);
  EXPECT_EQ(*ReferencePlane(std::vector<int16_t>(4, 8192), 2, 2, 1).square_sum(0, 0), -32768);
  EXPECT_EQ(*ReferencePlane(std::vector<int16_t>(4, 16382), 2, 2, 1).square_sum(0, 0), -8);
}

}  // namespace
}  // namespace hmlfc
