#include "scenes/tone.hpp"
#include "scenes/toy_parts.hpp"

namespace hmlfc::scenes {
namespace {

constexpr Vec3 kStone = from_rgb(0xA39C8F);
constexpr Vec3 kRoof = from_rgb(0x8C2F2A);
constexpr Vec3 kPole = from_rgb(0x4A3420);

void add_part(World& world, ShapeKind kind, Vec3 centre, Vec3 half, Vec3 colour,
              ToyMaterial material) {
  Shape shape(kind, centre, Frame{}, half);
  shape.colour = colour;
  shape.material = static_cast<uint32_t>(material);
  world.push_back(shape);
}

void add_tower(World& world, double x, double z) {
  add_part(world, ShapeKind::kCylinder, {x, 2.2, z}, {1.35, 2.2, 1.35}, kStone,
           ToyMaterial::kBricks);
  add_part(world, ShapeKind::kCylinder, {x, 4.3, z}, {1.6, 0.25, 1.6}, kStone,
           ToyMaterial::kPlastic);
  // Eight merlons around the top: the corners and edge middles of a square, drawn in to a circle.
  for (const double dx : {-1.0, 0.0, 1.0}) {
    for (const double dz : {-1.0, 0.0, 1.0}) {
      if (dx == 0.0 && dz == 0.0) continue;
      const double reach = dx != 0.0 && dz != 0.0 ? 0.95 : 1.35;
      add_part(world, ShapeKind::kBox, {x + reach * dx, 4.82, z + reach * dz}, {0.22, 0.28, 0.22},
               kStone, ToyMaterial::kPlastic);
    }
  }
  add_part(world, ShapeKind::kCylinder, {x, 5.3, z}, {0.05, 0.9, 0.05}, kPole,
           ToyMaterial::kPlastic);
  add_part(world, ShapeKind::kBox, {x + 0.55, 5.85, z}, {0.5, 0.28, 0.02}, kRoof,
           ToyMaterial::kPlastic);
}

}  // namespace

void add_castle(World& world, double z) {
  constexpr double kHalfLength = 11.0;
  add_part(world, ShapeKind::kBox, {0, 1.5, z}, {kHalfLength, 1.5, 0.5}, kStone,
           ToyMaterial::kBricks);
  add_part(world, ShapeKind::kBox, {0, 3.05, z}, {kHalfLength, 0.06, 0.6}, kStone * 0.8,
           ToyMaterial::kPlastic);
  for (int i = -13; i <= 13; ++i) {
    add_part(world, ShapeKind::kBox, {0.8 * i, 3.38, z - 0.45}, {0.25, 0.28, 0.12}, kStone,
             ToyMaterial::kPlastic);
  }
  add_part(world, ShapeKind::kBox, {0, 2.0, z - 0.25}, {1.7, 2.0, 0.6}, kStone, ToyMaterial::kGate);
  for (int i = -2; i <= 2; ++i) {
    add_part(world, ShapeKind::kBox, {0.76 * i, 4.25, z - 0.7}, {0.22, 0.27, 0.14}, kStone,
             ToyMaterial::kPlastic);
  }
  add_tower(world, -5.2, z - 0.3);
  add_tower(world, 5.2, z - 0.3);
}

}  // namespace hmlfc::scenes
