// Rays against shapes, alone and in tiles, and the shadows that shapes throw.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenes/hash_noise.hpp"
#include "scenes/shadow_map.hpp"
#include "scenes/shape.hpp"
#include "scenes/world.hpp"

namespace hmlfc::scenes {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

/// A ray along +z through (x, y), from z = 0.
Ray along_z(double x, double y) { return {{x, y, 0}, {0, 0, 1}}; }

TEST(Shape, TurnedFramesAreOrthonormalAndTurnByTheHalfTangent) {
  const Frame frame = turned(0.3, -0.7, 1.1);
  for (const Vec3 axis : {frame.x, frame.y, frame.z}) EXPECT_NEAR(length(axis), 1.0, 1e-12);
  expect_near(cross(frame.x, frame.y), frame.z);
  const Frame quarter = turned(0, 0, 1);  // half of 90 degrees has the tangent 1
  expect_near(quarter.x, {0, 1, 0});
  expect_near(quarter.y, {-1, 0, 0});
  expect_near(turned(1, 0, 0).y, {0, 0, 1});
  expect_near(turned(0, 1, 0).z, {1, 0, 0});
}

TEST(Shape, RaysEnterAnEllipsoid) {
  const Shape shape(ShapeKind::kEllipsoid, {1, 2, 10}, Frame{}, {1, 2, 3});
  EXPECT_NEAR(shape.enter(along_z(1, 2)), 7.0, 1e-12);
  EXPECT_NEAR(shape.enter(along_z(1.6, 2)), 10.0 - 3.0 * 0.8, 1e-12);
  EXPECT_EQ(shape.enter(along_z(2.01, 2)), kNever);
  EXPECT_EQ(shape.enter({{1, 2, 20}, {0, 0, 1}}), kNever) << "behind the origin";
  EXPECT_EQ(shape.enter({{1, 2, 10}, {0, 0, 1}}), kNever) << "from within";
  expect_near(shape.normal(shape.local({1, 2, 7})), {0, 0, -1});
  expect_near(shape.normal(shape.local({1, 4, 10})), {0, 1, 0});
}

TEST(Shape, RaysEnterABox) {
  const Shape shape(ShapeKind::kBox, {0, 0, 10}, Frame{}, {1, 2, 3});
  EXPECT_NEAR(shape.enter(along_z(0.99, -1.99)), 7.0, 1e-12);
  EXPECT_EQ(shape.enter(along_z(1.01, 0)), kNever);
  EXPECT_EQ(shape.enter(along_z(0, -2.01)), kNever);
  EXPECT_NEAR(shape.enter({{-5, 0, 10}, {2, 0, 0}}), 2.0, 1e-12) << "in units of the direction";
  expect_near(shape.normal(shape.local({0.5, 0.5, 7})), {0, 0, -1});
  expect_near(shape.normal(shape.local({-1, 0.5, 9})), {-1, 0, 0});
  expect_near(shape.normal(shape.local({0.5, 2, 9})), {0, 1, 0});
}

TEST(Shape, NoShapeIsMetBehindOrFromWithin) {
  for (const ShapeKind kind : {ShapeKind::kEllipsoid, ShapeKind::kBox, ShapeKind::kCylinder}) {
    const Shape shape(kind, {0, 0, 10}, Frame{}, {1, 1, 1});
    EXPECT_NE(shape.enter(along_z(0, 0)), kNever);
    EXPECT_EQ(shape.enter({{0, 0, 20}, {0, 0, 1}}), kNever);
    EXPECT_EQ(shape.enter({{0, 0, 10}, {0, 0, 1}}), kNever);
  }
  const Shape sheet(ShapeKind::kSheet, {0, 0, 10}, Frame{}, {1, 1, 0});
  EXPECT_EQ(sheet.enter({{0, 0, 20}, {0, 0, 1}}), kNever);
}

TEST(Shape, ATurnedBoxShowsItsEdge) {
  const Shape shape(ShapeKind::kBox, {0, 0, 10}, turned(0, std::sqrt(2.0) - 1.0, 0), {1, 1, 1});
  EXPECT_NEAR(shape.enter(along_z(0, 0)), 10.0 - std::sqrt(2.0), 1e-9);  // turned by 45 degrees
  EXPECT_NEAR(shape.enter(along_z(1.0, 0)), 10.0 - std::sqrt(2.0) + 1.0, 1e-9);
  EXPECT_EQ(shape.enter(along_z(1.42, 0)), kNever);
}

TEST(Shape, RaysEnterACylinderThroughSideAndCap) {
  const Shape shape(ShapeKind::kCylinder, {0, 0, 10}, Frame{}, {2, 3, 2});
  EXPECT_NEAR(shape.enter(along_z(0, 2.9)), 8.0, 1e-12);
  EXPECT_EQ(shape.enter(along_z(0, 3.1)), kNever);
  EXPECT_EQ(shape.enter(along_z(2.1, 0)), kNever);
  EXPECT_NEAR(shape.enter({{0, -10, 10}, {0, 1, 0}}), 7.0, 1e-12);
  EXPECT_EQ(shape.enter({{2.1, -10, 10}, {0, 1, 0}}), kNever);
  expect_near(shape.normal(shape.local({0, 1, 8})), {0, 0, -1});
  expect_near(shape.normal(shape.local({0.5, -3, 10})), {0, -1, 0});
}

TEST(Shape, RaysMeetASheetWithRoundCornersFromBothSides) {
  Shape shape(ShapeKind::kSheet, {0, 0, 10}, Frame{}, {2, 3, 0});
  EXPECT_NEAR(shape.enter(along_z(1.99, 2.99)), 10.0, 1e-12);
  shape.corner_radius = 1.0;
  EXPECT_EQ(shape.enter(along_z(1.99, 2.99)), kNever);
  EXPECT_NEAR(shape.enter(along_z(1.99, 1.9)), 10.0, 1e-12);
  EXPECT_NEAR(shape.enter(along_z(1.7, 2.7)), 10.0, 1e-12);  // sqrt(0.7^2 + 0.7^2) < 1
  EXPECT_EQ(shape.enter(along_z(1.72, 2.72)), kNever);       // > 1
  EXPECT_NEAR(shape.enter({{0, 0, 15}, {0, 0, -1}}), 5.0, 1e-12);
  EXPECT_EQ(shape.enter(along_z(2.01, 0)), kNever);
}

World random_world(uint32_t count) {
  HashStream random(5, 6);
  World world;
  for (uint32_t i = 0; i < count; ++i) {
    const auto kind = static_cast<ShapeKind>(random.below(4));
    const Vec3 centre{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(6, 20)};
    const Frame frame = turned(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    world.emplace_back(
        kind, centre, frame,
        Vec3{random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1)});
  }
  return world;
}

TEST(TileBins, FindTheSameShapeAsASearchThroughAll) {
  const World world = random_world(150);
  constexpr CameraRig rig = {.centre = {0, 0, 0},
                             .right = {1, 0, 0},
                             .down = {0, -1, 0},
                             .forward = {0, 0, 1},
                             .focus = 10.0,
                             .depth_unit = 40.0,
                             .focal_sides = 1.2};
  SceneParams params;
  params.rows = params.cols = 3;
  params.width = 90;
  params.height = 70;
  const ViewCamera camera(rig, params, 2, 0);
  const TileBins bins(world, camera, params.width, params.height);
  size_t hits = 0;
  for (uint32_t y = 0; y < params.height; ++y) {
    for (uint32_t x = 0; x < params.width; ++x) {
      for (const double inside : {0.0, 0.4, 1.0}) {
        const Ray ray = camera.ray(x + inside, y + inside);
        Hit expected;
        for (const Shape& shape : world) {
          const double t = shape.enter(ray);
          if (t < expected.t) expected = {t, &shape};
        }
        const Hit hit = bins.first_hit(ray, x, y);
        ASSERT_EQ(hit.shape, expected.shape) << x << ", " << y;
        ASSERT_EQ(hit.t, expected.t);
        hits += hit.shape != nullptr ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 3000u) << "the test has too little to look at";
  EXPECT_LT(hits, 18900u);
}

TEST(ShadowMap, AShapeShadesWhatLiesBehindItOnly) {
  const World world = {Shape(ShapeKind::kBox, {0, 4, 0}, Frame{}, {1, 0.5, 1})};
  const ShadowMap shadows(world, {0, 1, 0}, {0, 0, 0}, 5.0, 500);
  const Vec3 up{0, 1, 0};
  EXPECT_EQ(shadows.lit({0, 0, 0}, up), 0.0);
  EXPECT_EQ(shadows.lit({0.9, 0, -0.9}, up), 0.0);
  EXPECT_EQ(shadows.lit({1.1, 0, 0}, up), 1.0);
  EXPECT_EQ(shadows.lit({0, 0, -1.1}, up), 1.0);
  EXPECT_EQ(shadows.lit({0, 4.5, 0}, up), 1.0) << "the lit side itself";
  EXPECT_EQ(shadows.lit({0, 6, 0}, up), 1.0) << "before the box";
  EXPECT_EQ(shadows.lit({100, 0, 100}, up), 1.0) << "outside of the map";
  const double edge = shadows.lit({1.0, 0, 0}, up);
  EXPECT_GT(edge, 0.0);
  EXPECT_LT(edge, 1.0);
}

TEST(ShadowMap, SlantedLightMovesTheShadow) {
  const World world = {Shape(ShapeKind::kEllipsoid, {0, 4, 0}, Frame{}, {0.5, 0.5, 0.5})};
  const ShadowMap shadows(world, {0.6, 0.8, 0}, {0, 0, 0}, 6.0, 600);
  EXPECT_EQ(shadows.lit({-3, 0, 0}, {0, 1, 0}), 0.0);  // 4 * 0.6 / 0.8 away from the lamp
  EXPECT_EQ(shadows.lit({0, 0, 0}, {0, 1, 0}), 1.0);
  EXPECT_EQ(shadows.lit({3, 0, 0}, {0, 1, 0}), 1.0);
}

}  // namespace
}  // namespace hmlfc::scenes
