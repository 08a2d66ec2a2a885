#include "scenes/shadow_map.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "scenes/hash_noise.hpp"

namespace hmlfc::scenes {
namespace {

constexpr double kFar = 1e4;  // from the map's centre back to its plane, world units

/// Any frame whose z axis is `z`, a unit vector that is not along the world's x axis.
Frame frame_along(Vec3 z) {
  const Vec3 y = normalize(cross(z, {1, 0, 0}));
  return {cross(y, z), y, z};
}

}  // namespace

ShadowMap::ShadowMap(std::span<const Shape> world, Vec3 towards_lamp, Vec3 centre, double reach,
                     uint32_t resolution)
    : frame_(frame_along(-towards_lamp)),
      corner_(centre - reach * frame_.x - reach * frame_.y - kFar * frame_.z),
      texel_(2.0 * reach / resolution),
      resolution_(resolution),
      depths_(size_t{resolution} * resolution, std::numeric_limits<float>::infinity()) {
  for (const Shape& shape : world) cast(shape);
}

void ShadowMap::cast(const Shape& shape) {
  double left = kFar;
  double top = kFar;
  double right = -kFar;
  double bottom = -kFar;
  for (const Vec3& corner : shape.corners()) {
    const double x = dot(corner - corner_, frame_.x) / texel_;
    const double y = dot(corner - corner_, frame_.y) / texel_;
    left = std::min(left, x);
    top = std::min(top, y);
    right = std::max(right, x);
    bottom = std::max(bottom, y);
  }
  const int64_t first_x = std::clamp<int64_t>(floor_to_int(left), 0, resolution_);
  const int64_t first_y = std::clamp<int64_t>(floor_to_int(top), 0, resolution_);
  const int64_t last_x = std::clamp<int64_t>(floor_to_int(right) + 1, 0, resolution_);
  const int64_t last_y = std::clamp<int64_t>(floor_to_int(bottom) + 1, 0, resolution_);
  for (int64_t y = first_y; y < last_y; ++y) {
    for (int64_t x = first_x; x < last_x; ++x) {
      const double across = (static_cast<double>(x) + 0.5) * texel_;
      const double along = (static_cast<double>(y) + 0.5) * texel_;
      const Ray ray{corner_ + across * frame_.x + along * frame_.y, frame_.z};
      float& depth = depths_[static_cast<size_t>(y * resolution_ + x)];
      depth = std::min(depth, static_cast<float>(shape.enter(ray)));
    }
  }
}

double ShadowMap::texel_lit(int64_t x, int64_t y, double depth) const {
  if (x < 0 || y < 0 || x >= resolution_ || y >= resolution_) return 1.0;
  return static_cast<double>(depths_[static_cast<size_t>(y * resolution_ + x)]) < depth ? 0.0 : 1.0;
}

double ShadowMap::lit(Vec3 point, Vec3 normal) const {
  // Two texels off the surface, which must not shadow itself.
  const Vec3 offset = point + (2.0 * texel_) * normal - corner_;
  const double depth = dot(offset, frame_.z) - texel_;
  const double x = dot(offset, frame_.x) / texel_ - 0.5;
  const double y = dot(offset, frame_.y) / texel_ - 0.5;
  const int64_t left = floor_to_int(x);
  const int64_t top = floor_to_int(y);
  const double u = x - static_cast<double>(left);
  const double v = y - static_cast<double>(top);
  // A box of 3 x 3 texels around the point; its outer columns and rows are weighted by coverage.
  const std::array<double, 4> across = {1.0 - u, 1.0, 1.0, u};
  const std::array<double, 4> down = {1.0 - v, 1.0, 1.0, v};
  double sum = 0.0;
  for (size_t j = 0; j < 4; ++j) {
    for (size_t i = 0; i < 4; ++i) {
      sum +=
          across[i] * down[j] *
          texel_lit(left - 1 + static_cast<int64_t>(i), top - 1 + static_cast<int64_t>(j), depth);
    }
  }
  return sum / 9.0;
}

}  // namespace hmlfc::scenes
