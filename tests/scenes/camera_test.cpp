// The two-plane geometry: what a grid step does to the picture of a point.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenes/view_camera.hpp"

namespace hmlfc::scenes {
namespace {

// Looks along +z with y downwards, so that world and picture run the same way.
constexpr CameraRig kRig = {.centre = {0, 0, 0},
                            .right = {1, 0, 0},
                            .down = {0, 1, 0},
                            .forward = {0, 0, 1},
                            .focus = 10.0,
                            .depth_unit = 5.0,
                            .focal_sides = 1.5};

SceneParams params_of(uint32_t rows, uint32_t cols) {
  SceneParams params;
  params.rows = rows;
  params.cols = cols;
  params.width = 400;
  params.height = 300;
  params.baseline_px = 3.0;
  return params;
}

PixelBox project(const SceneParams& params, uint32_t row, uint32_t col, Vec3 point) {
  return ViewCamera(kRig, params, row, col).bounds(std::array{point});
}

TEST(ViewCamera, PointsMoveByTheStatedDisparity) {
  const SceneParams params = params_of(4, 6);
  for (const double distance : {4.0, 5.0, 8.0, 10.0, 15.0, 100.0}) {
    const Vec3 point{0.3, -0.2, distance};
    const double depth = distance / 5.0;
    const double disparity = 3.0 * (1.0 / depth - 1.0 / 2.0);
    const PixelBox first = project(params, 0, 0, point);
    for (uint32_t row = 0; row < 4; ++row) {
      for (uint32_t col = 0; col < 6; ++col) {
        const PixelBox box = project(params, row, col, point);
        EXPECT_NEAR(box.left, first.left - disparity * col, 1e-9) << distance;
        EXPECT_NEAR(box.top, first.top - disparity * row, 1e-9) << distance;
      }
    }
  }
}

constexpr CameraRig kTurned = {.centre = {3, -2, 1},
                               .right = {0.6, 0, 0.8},
                               .down = {0, -1, 0},
                               .forward = {-0.8, 0, 0.6},
                               .focus = 10.0,
                               .depth_unit = 5.0,
                               .focal_sides = 1.5};

SceneParams arranged(Cameras cameras, double baseline_px) {
  SceneParams params = params_of(3, 4);
  params.cameras = cameras;
  params.baseline_px = baseline_px;
  return params;
}

// RIG-3: the direction `v` of the world in the axes of a camera turned by the quaternion `q`.
Vec3 in_camera(const std::array<double, 4>& q, Vec3 v) {
  const auto [w, x, y, z] = q;
  const Vec3 axis{-x, -y, -z};  // of the inverse
  const Vec3 t = 2 * cross(axis, v);
  return v + w * t + cross(axis, t);
}

// RIG-3 and RIG-4 see a point where the camera sees it, half a pixel apart as they count.
TEST(ViewCamera, TheRigSeesTheSame) {
  for (const Cameras cameras :
       {Cameras::kGrid, Cameras::kPlane, Cameras::kSphere, Cameras::kPath}) {
    const SceneParams params = arranged(cameras, 60);
    const bool turned = cameras == Cameras::kSphere || cameras == Cameras::kPath;
    const Rig rig = rig_of(kTurned, params);
    ASSERT_EQ(rig.positions.size(), 12u);
    ASSERT_EQ(rig.intrinsics.size(), 12u);
    ASSERT_EQ(rig.rotations.size(), turned ? 12u : 0u);
    for (const Vec3 point : {Vec3{-2, -1.5, 4}, Vec3{-9, -2, 12}, Vec3{1, -1, 3.5}}) {
      const Vec3 offset = point - kTurned.centre;
      for (size_t view = 0; view < 12; ++view) {
        const auto& [x, y, z] = rig.positions[view];
        const auto& [fx, fy, cx, cy] = rig.intrinsics[view];
        const Vec3 away = Vec3{dot(offset, kTurned.right), dot(offset, kTurned.down),
                               dot(offset, kTurned.forward)} -
                          Vec3{x, y, z};
        const Vec3 seen = turned ? in_camera(rig.rotations[view], away) : away;
        const ViewCamera camera(kTurned, params, static_cast<uint32_t>(view / 4),
                                static_cast<uint32_t>(view % 4));
        const PixelBox box = camera.bounds(std::array{point});
        EXPECT_NEAR(cx + fx * seen.x / seen.z, box.left - 0.5, 1e-9) << view;
        EXPECT_NEAR(cy + fy * seen.y / seen.z, box.top - 0.5, 1e-9) << view;
      }
    }
  }
}

TEST(ViewCamera, TurnedCamerasSeeTheMiddleOfTheFocalPlaneInTheirs) {
  const Vec3 middle = kTurned.centre + 10.0 * kTurned.forward;
  for (const Cameras cameras : {Cameras::kSphere, Cameras::kPath}) {
    const SceneParams params = arranged(cameras, 60);
    double farthest = 0;
    for (uint32_t view = 0; view < 12; ++view) {
      const ViewCamera camera(kTurned, params, view / 4, view % 4);
      const PixelBox box = camera.bounds(std::array{middle});
      EXPECT_NEAR(box.left, 200, 1e-9);
      EXPECT_NEAR(box.top, 150, 1e-9);
      EXPECT_NEAR(dot(camera.right(), kTurned.down), 0, 1e-12) << "the camera is not upright";
      const double distance = length(camera.origin() - middle);
      if (cameras == Cameras::kSphere) {
        EXPECT_NEAR(distance, 10, 1e-12);
      }
      farthest = std::max(farthest, length(camera.origin() - kTurned.centre));
    }
    EXPECT_GT(farthest, 0.5) << "all cameras stand in one place";
  }
}

// Jitter moves cameras in their plane, by what is said and differently with another seed.
TEST(ViewCamera, CamerasOfAPlaneAreOffTheGridByLessThanHalfAStep) {
  SceneParams params = arranged(Cameras::kPlane, 3);
  const Rig grid = rig_of(kTurned, arranged(Cameras::kGrid, 3));
  const Rig rig = rig_of(kTurned, params);
  params.seed = 2;
  EXPECT_NE(rig_of(kTurned, params), rig);
  const double step = grid.positions[1][0] - grid.positions[0][0];
  double most = 0;
  for (size_t view = 0; view < 12; ++view) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double off = std::abs(rig.positions[view][axis] - grid.positions[view][axis]) / step;
      EXPECT_LE(off, axis == 2 ? 0 : 0.35 + 1e-12);
      most = std::max(most, off);
    }
  }
  EXPECT_GT(most, 0.2);
}

// A box with a corner behind the camera may be anywhere in the picture.
TEST(ViewCamera, BoundsOfPointsBehindItHaveNoEnd) {
  const ViewCamera camera(kRig, params_of(1, 1), 0, 0);
  const PixelBox box = camera.bounds(std::array<Vec3, 2>{{{0, 0, 6}, {0, 0, 0}}});
  EXPECT_EQ(box.left, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(box.bottom, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hmlfc::scenes
