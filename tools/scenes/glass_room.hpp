// The room of scene "glass": table, wall, window lamp, and how they are lit.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/vec3.hpp"
#include "scenes/view_camera.hpp"

namespace hmlfc::scenes {

enum class BallKind : uint32_t { kGlass, kMetal, kLacquer, kStriped };

/// A ball on the table or in the air.
struct Ball {
  Vec3 centre;
  double radius = 1;
  BallKind kind = BallKind::kLacquer;
  Vec3 colour{1, 1, 1};  ///< of glass: the transmittance along a diameter
};

/// The table is y = 0, the back wall z = 6; a window in the ceiling is the lamp.
class GlassRoom {
 public:
  GlassRoom(uint64_t seed, const std::vector<Ball>& balls) : seed_(seed), balls_(balls) {}

  /// Where a ray that hits no ball ends.
  enum class Place { kTable, kWall, kCeiling };
  struct End {
    Place place;
    Vec3 point;  ///< on the table or the wall
  };
  End end(const Ray& ray) const;

  /// Reflectance of the table and of the wall at a point.
  Vec3 table_colour(Vec3 point) const;
  Vec3 wall_colour(Vec3 point) const;

  /// Light that arrives along a ray from the ceiling and its bright window.
  Vec3 ceiling_light(const Ray& ray) const;

  /// Light that reaches a surface at `point` with unit normal `normal`. The ball `myself`, if not
  /// null, casts no shadow on it.
  Vec3 arriving_light(Vec3 point, Vec3 normal, const Ball* myself) const;

  /// Unit vector from a point to the lamp's middle.
  static Vec3 towards_lamp(Vec3 point);

  /// The share of the lamp that a point sees: below 1 behind a ball, above 1 where glass focuses
  /// it.
  double lamp_seen(Vec3 point, const Ball* myself) const;

 private:
  uint64_t seed_;
  const std::vector<Ball>& balls_;
};

inline constexpr Vec3 kLampLight = {1.02, 0.95, 0.84};

}  // namespace hmlfc::scenes
