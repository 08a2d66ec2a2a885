// The parts of scene "knights": plastic figures and a castle of bricks.
#pragma once

#include <cstdint>

#include "scenes/vec3.hpp"
#include "scenes/world.hpp"

namespace hmlfc::scenes {

/// Shape::material of the parts.
enum class ToyMaterial : uint32_t {
  kPlastic,
  kHead,    ///< a cylinder with eyes and mouth on the side of -z
  kShield,  ///< a box with a cross on the side of -z
  kMetal,
  kBricks,  ///< joints and uneven colours, by world coordinates
  kGate,    ///< a dark arch on the side of -z
};

/// The look of one knight; colours are linear.
struct KnightLook {
  Vec3 coat;
  Vec3 legs;
  Vec3 plume;
  Vec3 emblem;
  double turn = 0.0;      ///< tangent of half the angle about the vertical
  bool has_lance = true;  ///< a sword otherwise
};

/// Adds a knight, about 2 units tall, who stands on the ground (y = 0) at (x, z) and looks along
/// -z.
void add_knight(World& world, double x, double z, const KnightLook& look);

/// Adds a wall with gate, battlements and two towers along x, centred at z.
void add_castle(World& world, double z);

}  // namespace hmlfc::scenes
