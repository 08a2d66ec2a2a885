#include "scenes/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hmlfc::scenes {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLeast = 1e-9;  // hits nearer than this are the surface the ray starts from

Vec3 apply(const Frame& rows, Vec3 v) { return {dot(rows.x, v), dot(rows.y, v), dot(rows.z, v)}; }

/// Keeps the division for a slab finite: a ray parallel to it gets huge distances instead.
double away_from_zero(double x) {
  constexpr double kTiny = 1e-30;
  if (x >= 0) return std::max(x, kTiny);
  return std::min(x, -kTiny);
}

/// The interval of t in which -1 <= origin + t * direction <= 1.
std::pair<double, double> cross_slab(double origin, double direction) {
  const double inverse = 1.0 / away_from_zero(direction);
  const double a = (-1.0 - origin) * inverse;
  const double b = (1.0 - origin) * inverse;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

Frame turned(double a, double b, double c) {
  const double s = 2.0 / (1.0 + a * a + b * b + c * c);
  return {{1.0 - s * (b * b + c * c), s * (a * b + c), s * (a * c - b)},
          {s * (a * b - c), 1.0 - s * (a * a + c * c), s * (b * c + a)},
          {s * (a * c + b), s * (b * c - a), 1.0 - s * (a * a + b * b)}};
}

Shape::Shape(ShapeKind kind, Vec3 centre, Frame frame, Vec3 half)
    : kind_(kind), centre_(centre), frame_(frame), half_(half) {
  if (kind == ShapeKind::kSheet) half_.z = 1e-3;
  to_own_ = {frame.x * (1.0 / half_.x), frame.y * (1.0 / half_.y), frame.z * (1.0 / half_.z)};
}

Vec3 Shape::local(Vec3 point) const { return apply(to_own_, point - centre_); }

double Shape::enter(const Ray& ray) const {
  const Ray own{local(ray.origin), apply(to_own_, ray.direction)};
  switch (kind_) {
    case ShapeKind::kEllipsoid:
      return enter_ellipsoid(own);
    case ShapeKind::kBox:
      return enter_box(own);
    case ShapeKind::kCylinder:
      return enter_cylinder(own);
    case ShapeKind::kSheet:
      break;
  }
  return enter_sheet(own);
}

double Shape::enter_ellipsoid(const Ray& own) const {
  const double a = dot(own.direction, own.direction);
  const double b = dot(own.origin, own.direction);
  const double c = dot(own.origin, own.origin) - 1.0;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kNever;
  const double t = (-b - std::sqrt(discriminant)) / a;
  return t > kLeast ? t : kNever;
}

double Shape::enter_box(const Ray& own) const {
  const auto x = cross_slab(own.origin.x, own.direction.x);
  const auto y = cross_slab(own.origin.y, own.direction.y);
  const auto z = cross_slab(own.origin.z, own.direction.z);
  const double first = std::max({x.first, y.first, z.first});
  const double last = std::min({x.second, y.second, z.second});
  return first <= last && first > kLeast ? first : kNever;
}

double Shape::enter_cylinder(const Ray& own) const {
  const Vec3 o = own.origin;
  const Vec3 d = own.direction;
  const auto [first_cap, last_cap] = cross_slab(o.y, d.y);
  const double a = away_from_zero(d.x * d.x + d.z * d.z);
  const double b = o.x * d.x + o.z * d.z;
  const double c = o.x * o.x + o.z * o.z - 1.0;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kNever;
  const double root = std::sqrt(discriminant);
  const double first = std::max(first_cap, (-b - root) / a);
  const double last = std::min(last_cap, (-b + root) / a);
  return first <= last && first > kLeast ? first : kNever;
}

double Shape::enter_sheet(const Ray& own) const {
  const double t = -own.origin.z / away_from_zero(own.direction.z);
  if (!(t > kLeast && t < 1e12)) return kNever;
  const double x = std::abs(own.origin.x + t * own.direction.x);
  const double y = std::abs(own.origin.y + t * own.direction.y);
  if (x > 1.0 || y > 1.0) return kNever;
  const double into_corner_x = (x - 1.0) * half_.x + corner_radius;
  const double into_corner_y = (y - 1.0) * half_.y + corner_radius;
  const bool in_corner = into_corner_x > 0 && into_corner_y > 0;
  const double squared = into_corner_x * into_corner_x + into_corner_y * into_corner_y;
  return in_corner && squared > corner_radius * corner_radius ? kNever : t;
}

Vec3 Shape::normal(Vec3 p) const {
  Vec3 own{};  // along the gradient, in own coordinates
  switch (kind_) {
    case ShapeKind::kEllipsoid:
      own = p;
      break;
    case ShapeKind::kBox: {
      const Vec3 size{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
      if (size.x >= size.y && size.x >= size.z) {
        own.x = p.x;
      } else if (size.y >= size.z) {
        own.y = p.y;
      } else {
        own.z = p.z;
      }
      break;
    }
    case ShapeKind::kCylinder:
      own = p.x * p.x + p.z * p.z < p.y * p.y ? Vec3{0, p.y, 0} : Vec3{p.x, 0, p.z};
      break;
    case ShapeKind::kSheet:
      return frame_.z;
  }
  return normalize(own.x * to_own_.x + own.y * to_own_.y + own.z * to_own_.z);
}

std::array<Vec3, 8> Shape::corners() const {
  std::array<Vec3, 8> result;
  for (unsigned i = 0; i < 8; ++i) {
    result[i] = centre_ + frame_.x * ((i & 1u) != 0 ? half_.x : -half_.x) +
                frame_.y * ((i & 2u) != 0 ? half_.y : -half_.y) +
                frame_.z * ((i & 4u) != 0 ? half_.z : -half_.z);
  }
  return result;
}

}  // namespace hmlfc::scenes
