// The cameras of a light field: parallel and sheared to one focal plane, or turned to its middle.
#pragma once

#include <array>
#include <span>

#include <hmlfc/rig.hpp>

#include "scenes/scene.hpp"
#include "scenes/vec3.hpp"

namespace hmlfc::scenes {

/// A half-line of points origin + t * direction, t > 0.
struct Ray {
  Vec3 origin;
  Vec3 direction;

  Vec3 at(double t) const { return origin + t * direction; }
};

/// The camera plane of a scene in world coordinates.
struct CameraRig {
  Vec3 centre;         ///< the middle of the view grid
  Vec3 right;          ///< unit vector along the pixels' x, and along the columns of views
  Vec3 down;           ///< unit vector along the pixels' y, and along the rows of views
  Vec3 forward;        ///< unit vector into the scene; right, down, forward are orthogonal
  double focus;        ///< distance along `forward` of the plane without parallax
  double depth_unit;   ///< world units in one unit of depth (see SceneParams)
  double focal_sides;  ///< focal length over the longer side of the picture
};

/// The cameras of all views as a stream may hold them (RIG-2): in the scene's units, with the axes
/// right, down and forward, from the middle of the grid. Without rotations where none is turned.
Rig rig_of(const CameraRig& rig, const SceneParams& params);

/// A rectangle of pixels in real coordinates.
struct PixelBox {
  double left;
  double top;
  double right;
  double bottom;
};

/// The camera of one view. Pixel (i, j) covers [i, i + 1] x [j, j + 1].
class ViewCamera {
 public:
  ViewCamera(const CameraRig& rig, const SceneParams& params, uint32_t row, uint32_t col);

  /// The ray through a point of the picture. Its direction advances by 1 along the camera's own
  /// forward axis, so that t is the distance from its plane.
  Ray ray(double x, double y) const;

  /// The bounding box of the projections of `points`; without end where one of them does not lie in
  /// front of the camera.
  PixelBox bounds(std::span<const Vec3> points) const;

  /// fx, fy, cx, cy of RIG-4, where the middle of pixel (0, 0) is at (0, 0).
  std::array<double, 4> intrinsics() const {
    return {focal_, focal_, axis_x_ - 0.5, axis_y_ - 0.5};
  }

  /// Where the camera is.
  const Vec3& origin() const { return origin_; }

  /// Unit vectors along the pixels' x, along their y and into the scene.
  const Vec3& right() const { return right_; }
  const Vec3& down() const { return down_; }
  const Vec3& forward() const { return forward_; }

  /// Distance of a point from the plane of the camera, along its forward axis.
  double distance(Vec3 point) const { return dot(point - origin_, forward_); }

 private:
  /// Puts the camera at steps_right, steps_down of the plane of `rig`, parallel to its axes.
  void place_in_plane(const CameraRig& rig, const SceneParams& params, double steps_right,
                      double steps_down);

  /// Puts the camera at `place`, in the axes of `rig` from its centre, turned to the middle of the
  /// focal plane and upright.
  void turn_to_middle(const CameraRig& rig, const SceneParams& params, Vec3 place);

  Vec3 origin_;
  Vec3 right_;
  Vec3 down_;
  Vec3 forward_;
  double focal_;   ///< pixels
  double axis_x_;  ///< where the direction `forward` meets the picture
  double axis_y_;
};

}  // namespace hmlfc::scenes
