// Soft shadows of a distant lamp, from a depth map of the scene as the lamp sees it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/scene.hpp"
#include "scenes/shape.hpp"
#include "scenes/vec3.hpp"

namespace hmlfc::scenes {

/// The side of a map, in texels, that suits pictures of this size.
inline uint32_t shadow_resolution(const SceneParams& params) {
  return std::clamp(2 * std::max(params.width, params.height), 256u, 2048u);
}

class ShadowMap {
 public:
  /// `towards_lamp` is a unit vector. The map is a square of half side `reach` around `centre`,
  /// perpendicular to the light, with `resolution`^2 texels. Points outside are lit.
  ShadowMap(std::span<const Shape> world, Vec3 towards_lamp, Vec3 centre, double reach,
            uint32_t resolution);

  /// The share of the lamp that a surface point sees, in [0, 1]; `normal` is the surface's unit
  /// normal on the side of the lamp. The edge of a shadow is about three texels wide.
  double lit(Vec3 point, Vec3 normal) const;

 private:
  void cast(const Shape& shape);
  double texel_lit(int64_t x, int64_t y, double depth) const;

  Frame frame_;  ///< z points away from the lamp
  Vec3 corner_;  ///< world point of the map's origin, as near to the lamp as any shape
  double texel_;
  int64_t resolution_;
  std::vector<float> depths_;  ///< distance of what the lamp sees from the corner's plane
};

}  // namespace hmlfc::scenes
