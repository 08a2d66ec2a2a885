#include "scenes/two_plane_camera.hpp"

#include <algorithm>
#include <limits>

namespace hmlfc::scenes {

TwoPlaneCamera::TwoPlaneCamera(const CameraRig& rig, const SceneParams& params, uint32_t row,
                               uint32_t col)
    : right_(rig.right), down_(rig.down), forward_(rig.forward) {
  focal_ = rig.focal_sides * std::max(params.width, params.height);
  const double steps_right = col - (params.cols - 1) / 2.0;
  const double steps_down = row - (params.rows - 1) / 2.0;
  const double step = params.baseline_px * rig.depth_unit / focal_;
  origin_ = rig.centre + (steps_right * step) * right_ + (steps_down * step) * down_;
  const double focus_shift = params.baseline_px * rig.depth_unit / rig.focus;
  axis_x_ = params.width / 2.0 + steps_right * focus_shift;
  axis_y_ = params.height / 2.0 + steps_down * focus_shift;
}

Ray TwoPlaneCamera::ray(double x, double y) const {
  const double across = (x - axis_x_) / focal_;
  const double along = (y - axis_y_) / focal_;
  return {origin_, forward_ + across * right_ + along * down_};
}

PixelBox TwoPlaneCamera::bounds(std::span<const Vec3> points) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PixelBox box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const Vec3& point : points) {
    const Vec3 offset = point - origin_;
    const double scale = focal_ / dot(offset, forward_);
    const double x = axis_x_ + dot(offset, right_) * scale;
    const double y = axis_y_ + dot(offset, down_) * scale;
    box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
           std::max(box.bottom, y)};
  }
  return box;
}

Rig rig_of(const CameraRig& rig, const SceneParams& params) {
  Rig cameras;
  for (uint32_t row = 0; row < params.rows; ++row) {
    for (uint32_t col = 0; col < params.cols; ++col) {
      const TwoPlaneCamera camera(rig, params, row, col);
      const Vec3 offset = camera.origin() - rig.centre;
      cameras.positions.push_back({dot(offset, rig.right), dot(offset, rig.down), 0});
      cameras.intrinsics.push_back(camera.intrinsics());
    }
  }
  return cameras;
}

}  // namespace hmlfc::scenes
