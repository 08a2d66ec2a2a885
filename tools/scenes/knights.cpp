// Scene "knights": ranks of toy knights on a studded plate before a castle; hundreds of small
// shapes that hide one another differently in each view.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scenes/hash_noise.hpp"
#include "scenes/painter.hpp"
#include "scenes/shadow_map.hpp"
#include "scenes/tone.hpp"
#include "scenes/toys.hpp"

namespace hmlfc::scenes {
namespace {

// The cameras look down by asin(8/17) at the point (0, 0.8, 0), 20 units away; y is up.
constexpr CameraRig kRig = {
    .centre = {0, 0.8 + 20.0 * 8.0 / 17.0, -20.0 * 15.0 / 17.0},
    .right = {1, 0, 0},
    .down = {0, -15.0 / 17.0, -8.0 / 17.0},
    .forward = {0, -8.0 / 17.0, 15.0 / 17.0},
    .focus = 20.0,
    .depth_unit = 50.0,
    .focal_sides = 1.3,
};
constexpr double kBackdrop = 12.0;  // z of the painted sky
constexpr Vec3 kAmbient = {0.25, 0.28, 0.33};
constexpr Vec3 kLamp = {0.95, 0.88, 0.76};
constexpr Vec3 kSkyLow = from_rgb(0xC9DCE8);
constexpr Vec3 kSkyHigh = from_rgb(0x6FA0CC);

constexpr std::array<Vec3, 6> kCoats = {from_rgb(0xB32025), from_rgb(0x1F4FA3), from_rgb(0xE0DCD0),
                                        from_rgb(0x2F7D3B), from_rgb(0x2B2B30), from_rgb(0xD9A21B)};

constexpr std::array<Vec3, 3> kEmblems = {kCoats[0], kCoats[1], kCoats[4]};

Vec3 towards_lamp() { return normalize({-0.55, 0.95, -0.55}); }

class Knights : public TracedPainter {
 public:
  explicit Knights(const SceneParams& params);

 protected:
  Vec3 light(const Ray& ray, const Hit& hit) const override;
  double background(const Ray& ray) const override;

 private:
  void add_army(HashStream& random);
  Vec3 ground_light(Vec3 p) const;
  Vec3 backdrop_light(Vec3 p) const;
  Vec3 shape_light(const Ray& ray, const Hit& hit) const;

  // Which of the planes behind the shapes a ray meets first, and where: t <= 0, none.
  struct Planes {
    bool is_ground;
    double t;
  };
  Planes planes(const Ray& ray) const;
  Vec3 base_colour(const Shape& shape, Vec3 point, Vec3 own) const;

  std::optional<ShadowMap> shadows_;
};

Knights::Knights(const SceneParams& params) : TracedPainter(params, kRig) {
  HashStream random(params.seed, 0x4A16475);
  add_army(random);
  add_castle(world(), 9.0);
  shadows_.emplace(world(), towards_lamp(), Vec3{0, 1, 1}, 13.5, shadow_resolution(params));
}

void Knights::add_army(HashStream& random) {
  constexpr int kRanks = 6;
  constexpr int kFiles = 9;
  for (int rank = 0; rank < kRanks; ++rank) {
    const Vec3 coat = kCoats[random.below(kCoats.size())];
    const Vec3 second = kCoats[random.below(kCoats.size())];
    for (int file = 0; file < kFiles; ++file) {
      KnightLook look;
      look.coat = random.below(4) == 0 ? second : coat;
      look.legs = kCoats[random.below(kCoats.size())] * 0.7;
      look.plume = kCoats[random.below(kCoats.size())];
      look.emblem = kEmblems[random.below(kEmblems.size())];
      look.turn = random.uniform(-0.3, 0.3);
      look.has_lance = random.below(3) == 0;
      const double spread = 1.5 + 0.1 * rank;
      const double x = (file - (kFiles - 1) / 2.0 + 0.5 * (rank % 2) - 0.25) * spread;
      const double z = -7.2 + 2.3 * rank;
      const double right = random.uniform(-0.2, 0.2);
      const double back = random.uniform(-0.25, 0.25);
      add_knight(world(), x + right, z + back, look);
    }
  }
}

/// A plate with a stud every half unit; their roundness is only painted.
Vec3 Knights::ground_light(Vec3 p) const {
  const double x = p.x * 2.0;
  const double z = p.z * 2.0;
  const double right = fraction(x) - 0.5;
  const double back = fraction(z) - 0.5;
  const double squared = right * right + back * back;
  const Vec3 lamp = towards_lamp();
  double shade = 1.0;
  const double shadow_right = right + 0.13 * lamp.x / lamp.y;
  const double shadow_back = back + 0.13 * lamp.z / lamp.y;
  if (squared < 0.09) {
    shade = 1.06;
  } else if (squared < 0.116) {
    shade = 1.0 + 1.1 * (right * lamp.x + back * lamp.z);
  } else if (shadow_right * shadow_right + shadow_back * shadow_back < 0.116) {
    shade = 0.66;
  }
  const int64_t plate_x = floor_to_int(p.x / 4.0);
  const int64_t plate_z = floor_to_int(p.z / 4.0);
  const bool joint = fraction(p.x / 4.0) < 0.008 || fraction(p.z / 4.0) < 0.01;
  const double tint = cell_noise(params().seed + 3, plate_x, plate_z);
  const double wear = layered_noise(params().seed + 5, p.x * 0.6, p.z * 0.6, 3);
  const Vec3 plate = mix(from_rgb(0x5E8C4A), from_rgb(0x86A05A), tint) * (0.8 + 0.35 * wear);
  const double lit = shadows_->lit(p, {0, 1, 0});
  return plate * (shade * (joint ? 0.5 : 1.0)) * (kAmbient + kLamp * (lamp.y * lit));
}

/// Clouds over two ridges of hills.
Vec3 Knights::backdrop_light(Vec3 p) const {
  const double ridge = 3.2 + 2.2 * layered_noise(params().seed + 40, p.x * 0.22, 0.5, 3);
  if (p.y < ridge - 1.1) return from_rgb(0x5F8A55) * (0.8 + 0.06 * p.y);
  const double far_ridge = 3.6 + 2.4 * layered_noise(params().seed + 50, p.x * 0.16, 0.5, 3);
  if (p.y < far_ridge) return from_rgb(0x86A79A);
  const double cloud = layered_noise(params().seed + 60, p.x * 0.35, p.y * 0.9, 4);
  const Vec3 sky = mix(kSkyLow, kSkyHigh, smooth_step(2.5, 9.0, p.y));
  return mix(sky, {0.93, 0.94, 0.96}, smooth_step(0.48, 0.75, cloud));
}

/// Bricks of 1.2 x 0.6 units, every other course shifted by half a brick.
Vec3 brick_colour(Vec3 stone, double along, double y, uint64_t seed) {
  const int64_t course = floor_to_int(y / 0.6);
  const double shifted = along / 1.2 + ((course & 1) != 0 ? 0.5 : 0.0);
  const bool joint = fraction(shifted) < 0.035 || fraction(y / 0.6) < 0.06;
  const double tint = cell_noise(seed, floor_to_int(shifted), course);
  return stone * (joint ? 0.45 : 0.78 + 0.36 * tint);
}

Vec3 head_colour(Vec3 skin, Vec3 own) {
  if (own.z > 0) return skin;
  const double side = std::abs(own.x);
  const bool eye = (side - 0.33) * (side - 0.33) + own.y * own.y * 0.7 < 0.013;
  const bool mouth = side < 0.30 && std::abs(own.y + 0.55 - 1.2 * own.x * own.x) < 0.09;
  return eye || mouth ? skin * 0.04 : skin;
}

Vec3 shield_colour(Vec3 emblem, Vec3 own) {
  constexpr Vec3 kField = from_rgb(0xE9E4D4);
  if (own.z > -0.99) return from_rgb(0x777777);
  const double rim = std::max(std::abs(own.x), std::abs(own.y));
  if (rim > 0.88) return from_rgb(0x8A8A90);
  return std::abs(own.x) < 0.22 || std::abs(own.y - 0.15) < 0.17 ? emblem : kField;
}

Vec3 Knights::base_colour(const Shape& shape, Vec3 point, Vec3 own) const {
  switch (static_cast<ToyMaterial>(shape.material)) {
    case ToyMaterial::kHead:
      return head_colour(shape.colour, own);
    case ToyMaterial::kShield:
      return shield_colour(shape.colour, own);
    case ToyMaterial::kBricks:
      return brick_colour(shape.colour, point.x, point.y, params().seed);
    case ToyMaterial::kGate: {
      const double across = point.x;
      const double up = std::max(0.0, point.y - 1.6);
      const bool open = own.z < -0.99 && across * across + up * up < 1.0;
      return open ? from_rgb(0x241C16)
                  : brick_colour(shape.colour, point.x, point.y, params().seed);
    }
    case ToyMaterial::kPlastic:
    case ToyMaterial::kMetal:
      break;
  }
  return shape.colour;
}

Vec3 Knights::shape_light(const Ray& ray, const Hit& hit) const {
  const Vec3 p = ray.at(hit.t);
  const Vec3 own = hit.shape->local(p);
  const Vec3 normal = hit.shape->normal(own);
  const Vec3 lamp = towards_lamp();
  const Vec3 view = normalize(ray.direction);
  const Vec3 base = base_colour(*hit.shape, p, own);
  const double facing = dot(normal, lamp);
  const double lit = facing > 0 ? facing * shadows_->lit(p, normal) : 0.0;
  const double open = (0.55 + 0.45 * std::min(1.0, p.y)) * (0.75 + 0.25 * normal.y);
  const double gloss = std::max(0.0, dot(normalize(lamp - view), normal));
  if (hit.shape->material == static_cast<uint32_t>(ToyMaterial::kMetal)) {
    const Vec3 mirrored = view - (2.0 * dot(view, normal)) * normal;
    const Vec3 around = mix(from_rgb(0x4A5A3A), kSkyLow, smooth_step(-0.25, 0.35, mirrored.y));
    return base * (around * (0.35 + 0.65 * open) + kLamp * (0.45 * lit)) +
           kLamp * (lit * power_of_two_power(gloss, 5));
  }
  return base * (kAmbient * open + kLamp * lit) +
         kLamp * (0.25 * lit * power_of_two_power(gloss, 5));
}

/// Extreme grids put cameras below the ground; their rays may hit neither plane.
Knights::Planes Knights::planes(const Ray& ray) const {
  constexpr double kLeastSlope = 1e-4;
  const Vec3 d = ray.direction;
  const double ground = d.y < -kLeastSlope ? -ray.origin.y / d.y : -1.0;
  const double backdrop = d.z > kLeastSlope ? (kBackdrop - ray.origin.z) / d.z : -1.0;
  const bool is_ground = ground > 0 && (backdrop <= 0 || ground < backdrop);
  return {is_ground, is_ground ? ground : backdrop};
}

double Knights::background(const Ray& ray) const {
  const double t = planes(ray).t;
  return t > 0 ? t : TracedPainter::background(ray);
}

Vec3 Knights::light(const Ray& ray, const Hit& hit) const {
  if (hit.shape != nullptr) return shape_light(ray, hit);
  const Planes planes = this->planes(ray);
  if (planes.is_ground) return ground_light(ray.at(planes.t));
  return planes.t > 0 ? backdrop_light(ray.at(planes.t)) : kSkyLow;
}

}  // namespace

std::unique_ptr<Painter> make_knights(const SceneParams& params) {
  return std::make_unique<Knights>(params);
}

}  // namespace hmlfc::scenes
