// Vectors of three doubles: points, directions and linear colours.
#pragma once

#include <algorithm>
#include <cmath>

namespace hmlfc::scenes {

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(double s, Vec3 a) { return a * s; }
/// Componentwise: a colour seen through a filter or in coloured light.
constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a * (1.0 / length(a)); }

/// From a (t = 0) to b (t = 1).
constexpr double mix(double a, double b, double t) { return a + (b - a) * t; }
constexpr Vec3 mix(Vec3 a, Vec3 b, double t) { return a + (b - a) * t; }

/// 0 below `low`, 1 above `high`, a smooth cubic between; low < high.
constexpr double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// x^(2^doublings) for x >= 0: sharpens a cosine into a highlight.
constexpr double power_of_two_power(double x, int doublings) {
  for (int i = 0; i < doublings; ++i) x *= x;
  return x;
}

}  // namespace hmlfc::scenes
