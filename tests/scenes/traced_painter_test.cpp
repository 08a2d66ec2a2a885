// How rays become pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "scenes/painter.hpp"

namespace hmlfc::scenes {
namespace {

constexpr CameraRig kWallRig = {.centre = {0, 0, 0},
                                .right = {1, 0, 0},
                                .down = {0, 1, 0},
                                .forward = {0, 0, 1},
                                .focus = 1.0,
                                .depth_unit = 1.0,
                                .focal_sides = 1.0};

SceneParams wall_params(uint32_t width, uint32_t height) {
  SceneParams params;
  params.rows = 1;
  params.cols = 1;
  params.width = width;
  params.height = height;
  return params;
}

/// Light 1 left of a vertical edge in the picture, `right_light` right of it.
class Edge : public TracedPainter {
 public:
  Edge(uint32_t width, uint32_t height, double edge_x, double right_light)
      : TracedPainter(wall_params(width, height), kWallRig),
        edge_x_(edge_x),
        right_light_(right_light) {}

  RgbImage picture() const {
    RgbImage view{params().width, params().height, 8, {}};
    view.samples.resize(size_t{view.width} * view.height * 3);
    paint(0, 0, view);
    return view;
  }

 protected:
  Vec3 light(const Ray& ray, const Hit&) const override {
    const double x = ray.direction.x * params().width + params().width / 2.0;
    return x < edge_x_ ? Vec3{1, 1, 1} : Vec3{right_light_, right_light_, right_light_};
  }

 private:
  double edge_x_;
  double right_light_;
};

TEST(TracedPainter, APixelIsTheMeanOfItsLight) {
  // Left of the edge lie two of the corners, whose mean counts once, and two of the four rays.
  const RgbImage view = Edge(8, 3, 3.5, 0.0).picture();
  const auto half = static_cast<uint16_t>(std::lround(std::sqrt(0.5) * 255));
  for (size_t y = 0; y < 3; ++y) {
    for (size_t x = 0; x < 8; ++x) {
      const uint16_t expected = x < 3 ? 255 : (x == 3 ? half : 0);
      for (size_t c = 0; c < 3; ++c) EXPECT_EQ(view.samples[(y * 8 + x) * 3 + c], expected) << x;
    }
  }
}

TEST(TracedPainter, MoreOfAPixelIsMoreLight) {
  int before = -1;
  for (const double edge : {3.05, 3.2, 3.45, 3.7, 3.95}) {
    const int sample = Edge(8, 1, edge, 0.0).picture().samples[9];
    EXPECT_GT(sample, before);
    before = sample;
  }
}

TEST(TracedPainter, FaintEdgesAreAveragedFromTheCornersAlone) {
  const RgbImage view = Edge(8, 1, 3.9, 0.95).picture();
  EXPECT_EQ(view.samples[9], std::lround(std::sqrt(0.975) * 255));
}

}  // namespace
}  // namespace hmlfc::scenes
