// The solids and sheets that scenes are built of.
#pragma once

#include <array>
#include <cstdint>

#include "scenes/vec3.hpp"
#include "scenes/view_camera.hpp"

namespace hmlfc::scenes {

/// Three orthogonal unit vectors.
struct Frame {
  Vec3 x{1, 0, 0};
  Vec3 y{0, 1, 0};
  Vec3 z{0, 0, 1};
};

/// The frame rotated by the quaternion (1, a, b, c). Where b = c = 0, this is a rotation about x
/// by 2 atan(a); likewise for y and z.
Frame turned(double a, double b, double c);

enum class ShapeKind : uint8_t {
  kEllipsoid,  ///< within the box
  kBox,
  kCylinder,  ///< along y, with caps
  kSheet,     ///< the rectangle z = 0 with rounded corners, seen from both sides
};

/// A unit shape, [-1, 1]^3 in its own coordinates, stretched, turned and placed in the world.
class Shape {
 public:
  /// `half` are the half sizes along the frame's axes, each > 0; a sheet ignores half.z.
  Shape(ShapeKind kind, Vec3 centre, Frame frame, Vec3 half);

  /// The t at which a ray enters, or infinity. A ray that starts inside a solid does not hit it.
  double enter(const Ray& ray) const;

  /// A world point in the shape's own coordinates.
  Vec3 local(Vec3 point) const;

  /// The outward unit normal at a surface point in own coordinates; of a sheet, its z axis.
  Vec3 normal(Vec3 local_point) const;

  /// The corners of a box that holds the shape.
  std::array<Vec3, 8> corners() const;

  double corner_radius = 0.0;  ///< of a sheet, world units
  Vec3 colour{1, 1, 1};        ///< linear, for the scene's own use, as is the material
  uint32_t material = 0;

 private:
  double enter_ellipsoid(const Ray& own) const;
  double enter_box(const Ray& own) const;
  double enter_cylinder(const Ray& own) const;
  double enter_sheet(const Ray& own) const;

  ShapeKind kind_;
  Vec3 centre_;
  Frame frame_;
  Vec3 half_;
  Frame to_own_;  ///< the frame's axes, each divided by its half size
};

}  // namespace hmlfc::scenes
