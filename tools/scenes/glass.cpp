// Scene "glass": balls of glass, metal and lacquer on a polished table. Reflections and refractions
// do not move with the surfaces, so no shift of a view predicts the next one.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scenes/glass_room.hpp"
#include "scenes/hash_noise.hpp"
#include "scenes/painter.hpp"
#include "scenes/tone.hpp"

namespace hmlfc::scenes {
namespace {

// The cameras look down by asin(7/25) at the point (0, 1, 0), 10 units away; y is up.
constexpr CameraRig kRig = {
    .centre = {0, 1.0 + 10.0 * 7.0 / 25.0, -10.0 * 24.0 / 25.0},
    .right = {1, 0, 0},
    .down = {0, -24.0 / 25.0, -7.0 / 25.0},
    .forward = {0, -7.0 / 25.0, 24.0 / 25.0},
    .focus = 10.0,
    .depth_unit = 22.0,
    .focal_sides = 1.3,
};
constexpr double kIndex = 1.5;  // of refraction
constexpr int kMaxBounces = 3;  // of one camera ray

Vec3 mirrored(Vec3 direction, Vec3 normal) {
  return direction - (2.0 * dot(direction, normal)) * normal;
}

/// The unit vector `direction` after refraction at a surface; `ratio` = index before / index
/// behind, `normal` points against `direction`. A path through a ball has no total reflection.
Vec3 refracted(Vec3 direction, Vec3 normal, double ratio) {
  const double cosine = -dot(direction, normal);
  const double squared = std::max(0.0, 1.0 - ratio * ratio * (1.0 - cosine * cosine));
  return ratio * direction + (ratio * cosine - std::sqrt(squared)) * normal;
}

/// Schlick's approximation of the share of reflected light; `straight` is that at normal incidence.
double mirror_share(double straight, double cosine) {
  const double slant = 1.0 - std::clamp(cosine, 0.0, 1.0);
  return straight + (1.0 - straight) * slant * slant * slant * slant * slant;
}

class Glass : public TracedPainter {
 public:
  explicit Glass(const SceneParams& params);

 protected:
  Vec3 light(const Ray& ray, const Hit& hit) const override {
    if (hit.shape == nullptr) return room_light(ray, 0);
    return ball_light(balls_[hit.shape->material], ray.at(hit.t), normalize(ray.direction), 0);
  }
  double background(const Ray& ray) const override {
    const GlassRoom::End end = room_.end(ray);
    if (end.place == GlassRoom::Place::kCeiling) return TracedPainter::background(ray);
    return dot(end.point - ray.origin, kRig.forward);
  }

 private:
  void add_balls(HashStream& random);
  Vec3 ball_light(const Ball& ball, Vec3 point, Vec3 direction, int bounces) const;
  Vec3 trace_on(Vec3 origin, Vec3 direction, int bounces) const;
  Vec3 room_light(const Ray& ray, int bounces) const;
  Vec3 through_glass(const Ball& ball, Vec3 point, Vec3 normal, Vec3 direction, int bounces) const;
  Vec3 lacquer_colour(const Ball& ball, Vec3 normal) const;

  std::vector<Ball> balls_;
  GlassRoom room_;
};

Glass::Glass(const SceneParams& params) : TracedPainter(params, kRig), room_(params.seed, balls_) {
  HashStream random(params.seed, 0x61A55);
  add_balls(random);
  for (size_t i = 0; i < balls_.size(); ++i) {
    const double r = balls_[i].radius;
    Shape shape(ShapeKind::kEllipsoid, balls_[i].centre, Frame{}, {r, r, r});
    shape.material = static_cast<uint32_t>(i);
    world().push_back(shape);
  }
}

void Glass::add_balls(HashStream& random) {
  constexpr std::array<uint32_t, 6> kPaints = {0xB3202A, 0x1D4E9E, 0xD98E1C,
                                               0x2C7A4B, 0x6A2F86, 0xC9C3B4};
  struct Spot {
    double x;
    double z;
    double radius;
    BallKind kind;
    uint32_t rgb;  ///< 0: the next paint
  };
  constexpr std::array<Spot, 12> kSpots = {{
      {-1.15, -1.0, 1.15, BallKind::kGlass, 0xF4FAF8},
      {1.75, -2.0, 0.75, BallKind::kGlass, 0xF2D9A4},
      {1.15, 0.9, 1.0, BallKind::kMetal, 0xD8D8DA},
      {3.0, -0.4, 0.70, BallKind::kStriped, 0},
      {-3.15, 0.5, 0.85, BallKind::kLacquer, 0},
      {0.45, -2.9, 0.42, BallKind::kMetal, 0xE0B860},
      {-2.5, -2.6, 0.45, BallKind::kLacquer, 0},
      {-0.95, 2.6, 1.1, BallKind::kStriped, 0},
      {3.3, 2.5, 1.05, BallKind::kLacquer, 0},
      {-3.6, 3.4, 1.0, BallKind::kMetal, 0xC98A62},
      {-0.75, -3.7, 0.33, BallKind::kGlass, 0xA8DCE8},
      {1.2, -3.9, 0.28, BallKind::kLacquer, 0},
  }};
  size_t next_paint = random.below(kPaints.size());
  for (const Spot& spot : kSpots) {
    const uint32_t rgb = spot.rgb != 0 ? spot.rgb : kPaints[next_paint++ % kPaints.size()];
    const Vec3 centre{spot.x + random.uniform(-0.08, 0.08), spot.radius,
                      spot.z + random.uniform(-0.08, 0.08)};
    balls_.push_back({centre, spot.radius, spot.kind, from_rgb(rgb)});
  }
}

/// Light that arrives along a ray from a surface; `direction` has unit length.
Vec3 Glass::trace_on(Vec3 origin, Vec3 direction, int bounces) const {
  constexpr double kStart = 1e-9;  // nearer than this is the surface itself
  double nearest = std::numeric_limits<double>::infinity();
  const Ball* met = nullptr;
  for (const Ball& ball : balls_) {
    const Vec3 to_ball = ball.centre - origin;
    const double along = dot(to_ball, direction);
    const double squared = ball.radius * ball.radius - dot(to_ball, to_ball) + along * along;
    if (along <= 0 || squared <= 0) continue;
    const double t = along - std::sqrt(squared);
    if (t > kStart && t < nearest) {
      nearest = t;
      met = &ball;
    }
  }
  if (met == nullptr) return room_light({origin, direction}, bounces);
  return ball_light(*met, origin + nearest * direction, direction, bounces);
}

Vec3 Glass::room_light(const Ray& ray, int bounces) const {
  const GlassRoom::End end = room_.end(ray);
  if (end.place == GlassRoom::Place::kCeiling) return room_.ceiling_light(ray);
  if (end.place == GlassRoom::Place::kWall) {
    return room_.wall_colour(end.point) * room_.arriving_light(end.point, {0, 0, -1}, nullptr);
  }
  const Vec3 up{0, 1, 0};
  const Vec3 body = room_.table_colour(end.point) * room_.arriving_light(end.point, up, nullptr);
  if (bounces >= 1) return body;
  const Vec3 direction = normalize(ray.direction);
  const double share = mirror_share(0.06, -direction.y);
  return body * (1.0 - share) + share * trace_on(end.point, mirrored(direction, up), bounces + 2);
}

Vec3 Glass::through_glass(const Ball& ball, Vec3 point, Vec3 normal, Vec3 direction,
                          int bounces) const {
  const Vec3 within = refracted(direction, normal, 1.0 / kIndex);
  const double path = -2.0 * ball.radius * dot(within, normal);
  const Vec3 far = point + path * within;
  const Vec3 far_normal = (far - ball.centre) * (-1.0 / ball.radius);
  const Vec3 left = mix(Vec3{1, 1, 1}, ball.colour, path / (2.0 * ball.radius));
  return left * trace_on(far, refracted(within, far_normal, kIndex), bounces + 1);
}

/// One broad stripe around the ball, or a single colour.
Vec3 Glass::lacquer_colour(const Ball& ball, Vec3 normal) const {
  constexpr Vec3 kIvory = from_rgb(0xEDE6D3);
  if (ball.kind != BallKind::kStriped) return ball.colour;
  const double across = dot(normal, Vec3{0.48, 0.80, 0.36});
  return std::abs(across) < 0.42 ? ball.colour : kIvory;
}

Vec3 Glass::ball_light(const Ball& ball, Vec3 point, Vec3 direction, int bounces) const {
  const Vec3 normal = (point - ball.centre) * (1.0 / ball.radius);
  const Vec3 mirror = mirrored(direction, normal);
  const double cosine = -dot(direction, normal);
  if (bounces >= kMaxBounces) return ball.colour * room_.arriving_light(point, normal, &ball);

  const Vec3 reflected = trace_on(point, mirror, std::max(bounces + 1, 2));
  if (ball.kind == BallKind::kMetal) return ball.colour * reflected;
  const double share = mirror_share(0.04, cosine);
  if (ball.kind == BallKind::kGlass) {
    return mix(through_glass(ball, point, normal, direction, bounces), reflected, share);
  }
  const Vec3 body = lacquer_colour(ball, normal) * room_.arriving_light(point, normal, &ball);
  const double glint = std::max(0.0, dot(mirror, GlassRoom::towards_lamp(point)));
  const double phong = 0.5 * power_of_two_power(glint, 6) * room_.lamp_seen(point, &ball);
  return mix(body, reflected, share) + phong * kLampLight;
}

}  // namespace

std::unique_ptr<Painter> make_glass(const SceneParams& params) {
  return std::make_unique<Glass>(params);
}

}  // namespace hmlfc::scenes
