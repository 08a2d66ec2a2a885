// The shapes of a scene, and which of them a ray hits first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "scenes/shape.hpp"
#include "scenes/view_camera.hpp"

namespace hmlfc::scenes {

/// The first hit of a ray.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  const Shape* shape = nullptr;  ///< null where the ray left the scene
};

/// All shapes of a scene.
using World = std::vector<Shape>;

/// For one camera, the shapes that each 16 x 16 tile of its picture may show.
class TileBins {
 public:
  TileBins(const World& world, const ViewCamera& camera, uint32_t width, uint32_t height);

  /// The first shape on the camera's ray `ray`, which passes through pixel (px, py).
  Hit first_hit(const Ray& ray, uint32_t px, uint32_t py) const;

 private:
  struct Entry {
    const Shape* shape;
    double nearest;  ///< no point of the shape is nearer to the camera plane
  };
  struct TileRange {
    uint32_t left, top, right, bottom;  ///< in tiles, inclusive
  };

  std::span<const Entry> tile(uint32_t px, uint32_t py) const;

  uint32_t tiles_across_;
  std::vector<uint32_t> starts_;  ///< of each tile's entries; one more at the end
  std::vector<Entry> entries_;    ///< of a tile, by ascending `nearest`
};

}  // namespace hmlfc::scenes
