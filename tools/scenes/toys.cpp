#include "scenes/toys.hpp"

#include "scenes/tone.hpp"

namespace hmlfc::scenes {

namespace {

constexpr Vec3 kStone = from_rgb(0xA39C8F);
constexpr Vec3 kRoof = from_rgb(0x8C2F2A);
constexpr Vec3 kPole = from_rgb(0x4A3420);

void add_part(World& world, ShapeKind kind, Vec3 centre, Vec3 half, Vec3 colour,
              ToyMaterial material = ToyMaterial::kPlastic, const Frame& frame = {}) {
  Shape shape(kind, centre, frame, half);
  shape.colour = colour;
  shape.material = static_cast<uint32_t>(material);
  world.push_back(shape);
}

void add_tower(World& world, double x, double z) {
  add_part(world, ShapeKind::kCylinder, {x, 2.2, z}, {1.35, 2.2, 1.35}, kStone,
           ToyMaterial::kBricks);
  add_part(world, ShapeKind::kCylinder, {x, 4.3, z}, {1.6, 0.25, 1.6}, kStone);
  // Eight merlons around the top: the corners and edge middles of a square, moved onto a circle.
  for (const double dx : {-1.0, 0.0, 1.0}) {
    for (const double dz : {-1.0, 0.0, 1.0}) {
      if (dx == 0.0 && dz == 0.0) continue;
      const double reach = dx != 0.0 && dz != 0.0 ? 0.95 : 1.35;
      add_part(world, ShapeKind::kBox, {x + reach * dx, 4.82, z + reach * dz}, {0.22, 0.28, 0.22},
               kStone);
    }
  }
  add_part(world, ShapeKind::kCylinder, {x, 5.3, z}, {0.05, 0.9, 0.05}, kPole);
  add_part(world, ShapeKind::kBox, {x + 0.55, 5.85, z}, {0.5, 0.28, 0.02}, kRoof);
}

constexpr Vec3 kSkin = from_rgb(0xE8B923);
constexpr Vec3 kSteel = from_rgb(0x9AA3AE);
constexpr Vec3 kBelt = from_rgb(0x33291F);
constexpr Vec3 kWood = from_rgb(0x7A4F2A);

/// Adds parts in the knight's own coordinates: x to his left, y up, -z forwards.
class KnightBuilder {
 public:
  KnightBuilder(World& world, Vec3 feet, const Frame& frame)
      : world_(world), feet_(feet), frame_(frame) {}

  void add(ShapeKind kind, Vec3 centre, Vec3 half, Vec3 colour,
           ToyMaterial material = ToyMaterial::kPlastic, const Frame& turn = {}) {
    const Frame turned_frame{to_world(turn.x), to_world(turn.y), to_world(turn.z)};
    add_part(world_, kind, feet_ + to_world(centre), half, colour, material, turned_frame);
  }

 private:
  Vec3 to_world(Vec3 v) const { return v.x * frame_.x + v.y * frame_.y + v.z * frame_.z; }

  World& world_;
  Vec3 feet_;
  Frame frame_;
};

void add_body(KnightBuilder& knight, const KnightLook& look) {
  for (const double side : {-1.0, 1.0}) {
    knight.add(ShapeKind::kBox, {0.21 * side, 0.33, 0.02}, {0.19, 0.29, 0.17}, look.legs);
    knight.add(ShapeKind::kBox, {0.21 * side, 0.07, -0.06}, {0.19, 0.07, 0.25}, look.legs * 0.6);
    knight.add(ShapeKind::kCylinder, {0.50 * side, 1.07, -0.08}, {0.11, 0.30, 0.11}, look.coat,
               ToyMaterial::kPlastic, turned(-0.18, 0.0, -0.12 * side));
    knight.add(ShapeKind::kEllipsoid, {0.57 * side, 0.78, -0.22}, {0.11, 0.11, 0.11}, kSkin);
  }
  knight.add(ShapeKind::kBox, {0, 0.67, 0}, {0.41, 0.06, 0.19}, kBelt);
  knight.add(ShapeKind::kBox, {0, 1.04, 0}, {0.40, 0.31, 0.19}, look.coat);
  knight.add(ShapeKind::kCylinder, {0, 1.38, 0}, {0.12, 0.05, 0.12}, kSkin);
}

void add_head(KnightBuilder& knight, const KnightLook& look) {
  knight.add(ShapeKind::kCylinder, {0, 1.57, 0}, {0.22, 0.17, 0.22}, kSkin, ToyMaterial::kHead);
  knight.add(ShapeKind::kCylinder, {0, 1.77, 0}, {0.27, 0.025, 0.27}, kSteel, ToyMaterial::kMetal);
  knight.add(ShapeKind::kEllipsoid, {0, 1.77, 0}, {0.25, 0.24, 0.25}, kSteel, ToyMaterial::kMetal);
  knight.add(ShapeKind::kEllipsoid, {0, 2.06, 0.08}, {0.07, 0.14, 0.20}, look.plume);
}

void add_arms(KnightBuilder& knight, const KnightLook& look) {
  knight.add(ShapeKind::kBox, {0.55, 0.88, -0.38}, {0.29, 0.36, 0.04}, look.emblem,
             ToyMaterial::kShield, turned(0.0, 0.12, 0.0));
  if (look.has_lance) {
    knight.add(ShapeKind::kCylinder, {-0.60, 1.30, -0.26}, {0.045, 1.28, 0.045}, kWood,
               ToyMaterial::kPlastic, turned(-0.05, 0.0, 0.03));
    knight.add(ShapeKind::kEllipsoid, {-0.68, 2.62, -0.39}, {0.06, 0.20, 0.06}, kSteel,
               ToyMaterial::kMetal, turned(-0.05, 0.0, 0.03));
    return;
  }
  const Frame raised = turned(-0.12, 0.0, 0.12);
  knight.add(ShapeKind::kBox, {-0.69, 1.36, -0.36}, {0.065, 0.50, 0.02}, kSteel,
             ToyMaterial::kMetal, raised);
  knight.add(ShapeKind::kBox, {-0.58, 0.88, -0.25}, {0.16, 0.035, 0.05}, kBelt,
             ToyMaterial::kPlastic, raised);
}

}  // namespace

void add_castle(World& world, double z) {
  constexpr double kHalfLength = 11.0;
  add_part(world, ShapeKind::kBox, {0, 1.5, z}, {kHalfLength, 1.5, 0.5}, kStone,
           ToyMaterial::kBricks);
  add_part(world, ShapeKind::kBox, {0, 3.05, z}, {kHalfLength, 0.06, 0.6}, kStone * 0.8);
  for (int i = -13; i <= 13; ++i) {
    add_part(world, ShapeKind::kBox, {0.8 * i, 3.38, z - 0.45}, {0.25, 0.28, 0.12}, kStone);
  }
  add_part(world, ShapeKind::kBox, {0, 2.0, z - 0.25}, {1.7, 2.0, 0.6}, kStone, ToyMaterial::kGate);
  for (int i = -2; i <= 2; ++i) {
    add_part(world, ShapeKind::kBox, {0.76 * i, 4.25, z - 0.7}, {0.22, 0.27, 0.14}, kStone);
  }
  add_tower(world, -5.2, z - 0.3);
  add_tower(world, 5.2, z - 0.3);
}

void add_knight(World& world, double x, double z, const KnightLook& look) {
  KnightBuilder knight(world, {x, 0, z}, turned(0.0, look.turn, 0.0));
  add_body(knight, look);
  add_head(knight, look);
  add_arms(knight, look);
}

}  // namespace hmlfc::scenes
