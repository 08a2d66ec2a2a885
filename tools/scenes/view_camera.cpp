#include "scenes/view_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/hash_noise.hpp"

namespace hmlfc::scenes {
namespace {

constexpr double kMostJitter = 0.35;  // of Cameras::kPlane, steps of the grid

// A view's place on the path of Cameras::kPath, in the axes of the rig from its centre: a wave from
// left to right, as long as all steps together, that comes nearer to the scene in its middle.
Vec3 place_on_path(const SceneParams& params, uint32_t row, uint32_t col, double step) {
  const double steps = static_cast<double>(params.rows) * params.cols - 1;
  if (steps == 0) return {};
  const double along = (static_cast<double>(row) * params.cols + col) / steps * 2 - 1;
  const double reach = steps * step / 2;
  const double bow = 1 - along * along;
  return {reach * along, reach * 0.5 * along * bow, reach * 0.25 * bow};
}

// The quaternion that turns the axes of `camera` into those of `rig` (RIG-3), for cameras turned by
// less than half a circle.
std::array<double, 4> rotation_of(const CameraRig& rig, const ViewCamera& camera) {
  const auto own = [&](Vec3 v) {
    return Vec3{dot(v, rig.right), dot(v, rig.down), dot(v, rig.forward)};
  };
  const Vec3 x = own(camera.right());
  const Vec3 y = own(camera.down());
  const Vec3 z = own(camera.forward());
  const double w = std::sqrt(1 + x.x + y.y + z.z) / 2;
  return {w, (y.z - z.y) / (4 * w), (z.x - x.z) / (4 * w), (x.y - y.x) / (4 * w)};
}

}  // namespace

ViewCamera::ViewCamera(const CameraRig& rig, const SceneParams& params, uint32_t row, uint32_t col)
    : right_(rig.right), down_(rig.down), forward_(rig.forward) {
  focal_ = rig.focal_sides * std::max(params.width, params.height);
  const double steps_right = col - (params.cols - 1) / 2.0;
  const double steps_down = row - (params.rows - 1) / 2.0;
  const double step = params.baseline_px * rig.depth_unit / focal_;
  switch (params.cameras) {
    case Cameras::kGrid:
      place_in_plane(rig, params, steps_right, steps_down);
      break;
    case Cameras::kPlane: {
      HashStream random(params.seed, uint64_t{0x91A7E} << 24 | (row << 12 | col));
      const double right = random.uniform(-kMostJitter, kMostJitter);
      const double down = random.uniform(-kMostJitter, kMostJitter);
      place_in_plane(rig, params, steps_right + right, steps_down + down);
      break;
    }
    case Cameras::kSphere: {
      const Vec3 back = normalize({steps_right * step, steps_down * step, -rig.focus});
      turn_to_middle(rig, params, Vec3{0, 0, rig.focus} + rig.focus * back);
      break;
    }
    case Cameras::kPath:
      turn_to_middle(rig, params, place_on_path(params, row, col, step));
  }
}

void ViewCamera::place_in_plane(const CameraRig& rig, const SceneParams& params, double steps_right,
                                double steps_down) {
  const double step = params.baseline_px * rig.depth_unit / focal_;
  origin_ = rig.centre + (steps_right * step) * right_ + (steps_down * step) * down_;
  const double focus_shift = params.baseline_px * rig.depth_unit / rig.focus;
  axis_x_ = params.width / 2.0 + steps_right * focus_shift;
  axis_y_ = params.height / 2.0 + steps_down * focus_shift;
}

void ViewCamera::turn_to_middle(const CameraRig& rig, const SceneParams& params, Vec3 place) {
  const auto to_world = [&](Vec3 v) {
    return v.x * rig.right + v.y * rig.down + v.z * rig.forward;
  };
  const Vec3 forward = normalize(Vec3{0, 0, rig.focus} - place);
  const Vec3 right = normalize({forward.z, 0, -forward.x});
  origin_ = rig.centre + to_world(place);
  forward_ = to_world(forward);
  right_ = to_world(right);
  down_ = to_world(cross(forward, right));
  axis_x_ = params.width / 2.0;
  axis_y_ = params.height / 2.0;
}

Ray ViewCamera::ray(double x, double y) const {
  const double across = (x - axis_x_) / focal_;
  const double along = (y - axis_y_) / focal_;
  return {origin_, forward_ + across * right_ + along * down_};
}

PixelBox ViewCamera::bounds(std::span<const Vec3> points) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PixelBox box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const Vec3& point : points) {
    const Vec3 offset = point - origin_;
    const double distance = dot(offset, forward_);
    if (!(distance > 0)) return {-kInfinity, -kInfinity, kInfinity, kInfinity};
    const double scale = focal_ / distance;
    const double x = axis_x_ + dot(offset, right_) * scale;
    const double y = axis_y_ + dot(offset, down_) * scale;
    box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
           std::max(box.bottom, y)};
  }
  return box;
}

Rig rig_of(const CameraRig& rig, const SceneParams& params) {
  Rig cameras;
  const bool turned = params.cameras == Cameras::kSphere || params.cameras == Cameras::kPath;
  for (uint32_t row = 0; row < params.rows; ++row) {
    for (uint32_t col = 0; col < params.cols; ++col) {
      const ViewCamera camera(rig, params, row, col);
      const Vec3 offset = camera.origin() - rig.centre;
      const double along = turned ? dot(offset, rig.forward) : 0;
      cameras.positions.push_back({dot(offset, rig.right), dot(offset, rig.down), along});
      cameras.intrinsics.push_back(camera.intrinsics());
      if (turned) cameras.rotations.push_back(rotation_of(rig, camera));
    }
  }
  return cameras;
}

}  // namespace hmlfc::scenes
