#include "scenes/glass_room.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/hash_noise.hpp"
#include "scenes/tone.hpp"

namespace hmlfc::scenes {
namespace {

constexpr double kWall = 6.0;     // z
constexpr double kCeiling = 9.0;  // y
constexpr Vec3 kLamp = {-3.5, kCeiling, -4.5};
constexpr double kLampReach = 2.2;  // half side of the square window
constexpr double kPenumbra = 0.10;  // width of a shadow's edge per unit of distance from its ball
constexpr Vec3 kAmbient = {0.26, 0.28, 0.32};

}  // namespace

GlassRoom::End GlassRoom::end(const Ray& ray) const {
  if (ray.direction.z > 1e-6) {
    const Vec3 point = ray.at((kWall - ray.origin.z) / ray.direction.z);
    if (point.y >= 0 && point.y <= kCeiling) return {Place::kWall, point};
  }
  if (ray.direction.y >= -1e-6) return {Place::kCeiling, {}};
  return {Place::kTable, ray.at(-ray.origin.y / ray.direction.y)};
}

/// Square tiles of two kinds of marble.
Vec3 GlassRoom::table_colour(Vec3 p) const {
  constexpr double kTile = 1.1;
  const double x = p.x / kTile + 0.5;
  const double z = p.z / kTile + 0.5;
  const int64_t tile_x = floor_to_int(x);
  const int64_t tile_z = floor_to_int(z);
  const double u = std::abs(fraction(x) - 0.5);
  const double v = std::abs(fraction(z) - 0.5);
  if (std::max(u, v) > 0.485) return from_rgb(0x8E8678);
  const uint64_t stone = seed_ + mix_bits(static_cast<uint64_t>(tile_x * 1000 + tile_z)) % 97;
  const double warp = layered_noise(stone, p.x * 1.3, p.z * 1.3, 3);
  const double vein = std::abs(fraction(0.6 * p.x + 0.4 * p.z + 2.0 * warp) - 0.5) * 2.0;
  const bool dark = ((tile_x + tile_z) & 1) != 0;
  const Vec3 body = dark ? from_rgb(0x2D3A40) : from_rgb(0xE4DCCB);
  const Vec3 line = dark ? from_rgb(0x6F8080) : from_rgb(0xB8A88E);
  return mix(line, body, smooth_step(0.0, 0.35, vein));
}

/// Striped paper over a wooden panel.
Vec3 GlassRoom::wall_colour(Vec3 p) const {
  if (p.y < 1.75) {
    const double across = fraction(p.x / 1.6);
    const bool frame = p.y > 1.62 || p.y < 0.2 || across < 0.05;
    const bool groove = !frame && (p.y > 1.45 || p.y < 0.4 || across < 0.14 || across > 0.91);
    const double grain = layered_noise(seed_ + 11, p.x * 6.0, p.y * 0.9, 3);
    return from_rgb(0x6E4527) * ((frame ? 1.15 : (groove ? 0.6 : 0.95)) * (0.75 + 0.5 * grain));
  }
  const double band = fraction(p.x / 0.8);
  const double up = fraction(p.y / 0.8 + (fraction(p.x / 1.6) < 0.5 ? 0.0 : 0.5)) - 0.5;
  const double side = (fraction(p.x / 0.8) - 0.25) * 1.6;
  const bool ornament = band < 0.5 && std::abs(side) + std::abs(up) < 0.24;
  if (ornament) return from_rgb(0xC9A24A);
  return band < 0.5 ? from_rgb(0x3E6A78) : from_rgb(0x7FA6A4);
}

Vec3 GlassRoom::ceiling_light(const Ray& ray) const {
  const Vec3 direction = ray.direction;
  if (direction.y > 1e-6) {
    const Vec3 p = ray.at((kCeiling - ray.origin.y) / direction.y);
    const double x = std::abs(p.x - kLamp.x);
    const double z = std::abs(p.z - kLamp.z);
    const bool bar = x < 0.12 || z < 0.12;
    if (std::max(x, z) < kLampReach && !bar) return {4.2, 4.0, 3.7};
  }
  const double up = direction.y / length(direction);
  return mix(from_rgb(0x6B5B50), from_rgb(0xA8A49C), smooth_step(-0.2, 0.9, up));
}

Vec3 GlassRoom::towards_lamp(Vec3 point) { return normalize(kLamp - point); }

double GlassRoom::lamp_seen(Vec3 point, const Ball* myself) const {
  const Vec3 lamp = towards_lamp(point);
  double seen = 1.0;
  for (const Ball& ball : balls_) {
    if (&ball == myself) continue;
    const Vec3 to_ball = ball.centre - point;
    const double along = dot(to_ball, lamp);
    if (along <= 0) continue;
    const double squared = dot(to_ball, to_ball) - along * along;
    const double edge = 0.02 + kPenumbra * along;
    const double outer = ball.radius + edge;
    if (squared >= outer * outer) continue;
    const double aside = std::sqrt(std::max(0.0, squared));
    const double hidden = 1.0 - smooth_step(ball.radius - edge, outer, aside);
    if (ball.kind != BallKind::kGlass) {
      seen *= 1.0 - hidden;
      continue;
    }
    const double centred = std::max(0.0, 1.0 - aside / (0.55 * ball.radius));
    seen *= 1.0 - 0.62 * hidden + 1.5 * centred * centred * centred;
  }
  return seen;
}

Vec3 GlassRoom::arriving_light(Vec3 point, Vec3 normal, const Ball* myself) const {
  const Vec3 lamp = towards_lamp(point);
  const double facing = dot(normal, lamp);
  const Vec3 around = kAmbient * (0.7 + 0.3 * normal.y);
  return facing > 0 ? around + kLampLight * (facing * lamp_seen(point, myself)) : around;
}

}  // namespace hmlfc::scenes
