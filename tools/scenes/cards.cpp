// Scene "cards": tilted playing cards and printed panels float at many depths in front of a green
// cloth and cast shadows on it.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "scenes/card_face.hpp"
#include "scenes/hash_noise.hpp"
#include "scenes/painter.hpp"
#include "scenes/shadow_map.hpp"
#include "scenes/tone.hpp"

namespace hmlfc::scenes {
namespace {

// The cameras look along +z, y is up. The focal plane, 10 world units away, is at depth 2.
constexpr CameraRig kRig = {
    .centre = {0, 0, 0},
    .right = {1, 0, 0},
    .down = {0, -1, 0},
    .forward = {0, 0, 1},
    .focus = 10.0,
    .depth_unit = 5.0,
    .focal_sides = 1.2,
};
constexpr double kAspect = 1.4;
// The cloth is the plane z = kClothDistance + kClothSlope * y.
constexpr double kClothDistance = 14.0;
constexpr double kClothSlope = 0.4;
constexpr Vec3 kAmbient = {0.30, 0.32, 0.36};
constexpr Vec3 kLamp = {0.92, 0.88, 0.78};

constexpr std::array<uint32_t, 6> kInks = {0x24508F, 0xA3262E, 0x1F6B52,
                                           0x6B3B86, 0xB8741F, 0x2B6E86};

Vec3 towards_lamp() { return normalize({-0.5, 0.8, -1.0}); }

/// Position of a sheet in the middle view.
struct SheetPlace {
  double u;  ///< of its centre, in half picture widths right of the picture's centre
  double v;  ///< in half picture heights above it
  double z;  ///< distance from the camera plane
  double half_width;
};

/// Rotated about each axis; the tangents of the half angles are random in [-most, most].
Frame random_turn(HashStream& random, const std::array<double, 3>& most) {
  std::array<double, 3> tangents{};
  for (size_t i = 0; i < 3; ++i) tangents[i] = random.uniform(-most[i], most[i]);
  return turned(tangents[0], tangents[1], tangents[2]);
}

class Cards : public TracedPainter {
 public:
  explicit Cards(const SceneParams& params);

 protected:
  Vec3 light(const Ray& ray, const Hit& hit) const override;
  double background(const Ray& ray) const override;

 private:
  void add_panels(HashStream& random);
  void add_loose_cards(HashStream& random);
  void add_fan(HashStream& random);
  void add_sheet(const SheetPlace& place, const Frame& frame, const CardFace& face);
  Vec3 cloth_light(const Ray& ray) const;

  double half_view_x_;  ///< half of the view's width at distance 1
  double half_view_y_;
  double scale_;  ///< of the sheets: 1 for a square picture
  std::vector<CardFace> faces_;
  std::optional<ShadowMap> shadows_;
};

Cards::Cards(const SceneParams& params) : TracedPainter(params, kRig) {
  const double longer = std::max(params.width, params.height);
  half_view_x_ = 0.5 * params.width / longer / kRig.focal_sides;
  half_view_y_ = 0.5 * params.height / longer / kRig.focal_sides;
  scale_ = std::sqrt(half_view_x_ * half_view_y_) * 2.0 * kRig.focal_sides;
  HashStream random(params.seed, 0xCA4D5);
  add_panels(random);
  add_loose_cards(random);
  add_fan(random);
  shadows_.emplace(world(), towards_lamp(), Vec3{0, 0, 10}, 10.0, shadow_resolution(params));
}

void Cards::add_sheet(const SheetPlace& place, const Frame& frame, const CardFace& face) {
  const double half = place.half_width * scale_;
  const double z = place.z;
  const Vec3 centre{place.u * half_view_x_ * z, place.v * half_view_y_ * z, z};
  Shape sheet(ShapeKind::kSheet, centre, frame, {half, half * kAspect, 0});
  sheet.corner_radius = 0.12 * half;
  sheet.material = static_cast<uint32_t>(faces_.size());
  world().push_back(sheet);
  faces_.push_back(face);
}

void Cards::add_panels(HashStream& random) {
  constexpr std::array<Print, 4> kPrints = {Print::kChecker, Print::kMarble, Print::kStripes,
                                            Print::kDots};
  constexpr std::array<std::array<double, 2>, 4> kPlaces = {
      {{-0.62, 0.50}, {0.60, 0.58}, {0.70, -0.42}, {-0.74, -0.52}}};
  for (size_t i = 0; i < kPrints.size(); ++i) {
    const CardFace face{kPrints[i], 1, 0, from_rgb(kInks[random.below(kInks.size())]),
                        random.next()};
    const Frame frame = random_turn(random, {0.12, 0.2, 0.25});
    const SheetPlace place{kPlaces[i][0] + random.uniform(-0.06, 0.06),
                           kPlaces[i][1] + random.uniform(-0.06, 0.06), random.uniform(10.8, 12.4),
                           random.uniform(1.2, 1.45)};
    add_sheet(place, frame, face);
  }
}

void Cards::add_loose_cards(HashStream& random) {
  constexpr int kAcross = 4;
  constexpr int kDown = 4;
  for (int i = 0; i < kAcross * kDown; ++i) {
    const int across = i % kAcross;
    const int up = i / kAcross;
    const double u = -0.78 + 1.56 * across / (kAcross - 1) + random.uniform(-0.14, 0.14);
    const double v = -0.74 + 1.50 * up / (kDown - 1) + random.uniform(-0.12, 0.12);
    CardFace face{Print::kFace, 1 + random.below(10), random.below(4),
                  from_rgb(kInks[random.below(2)]), random.next()};
    if (random.below(4) == 0) face.print = Print::kBack;
    const Frame frame = random_turn(random, {0.18, 0.22, 0.5});
    const SheetPlace place{u, v, random.uniform(6.6, 10.6), random.uniform(0.50, 0.62)};
    add_sheet(place, frame, face);
  }
}

void Cards::add_fan(HashStream& random) {
  constexpr int kCards = 5;
  const uint32_t suit = random.below(4);
  for (int i = 0; i < kCards; ++i) {
    const double turn = 0.16 * (i - 2);
    const CardFace face{Print::kFace, static_cast<uint32_t>(6 + i), suit, {}, 0};
    const SheetPlace place{-0.05 + 0.21 * (i - 2), -0.42 - 0.035 * (i - 2) * (i - 2),
                           5.6 - 0.16 * i, 0.42};
    add_sheet(place, turned(0.06, 0.0, -turn), face);
  }
}

// Where a ray meets the cloth.
double Cards::background(const Ray& ray) const {
  const double reach = kClothDistance - ray.origin.z + kClothSlope * ray.origin.y;
  // Only the outermost cameras of extreme grids have rays that miss the cloth.
  const double approach = std::max(0.01, ray.direction.z - kClothSlope * ray.direction.y);
  return reach / approach;
}

Vec3 Cards::cloth_light(const Ray& ray) const {
  const Vec3 out = normalize({0, kClothSlope, -1});
  const Vec3 p = ray.at(background(ray));
  const double broad = layered_noise(params().seed, p.x * 0.5, p.y * 0.5, 3);
  const double thread = value_noise(params().seed + 31, p.x * 9.0, p.y * 9.0);
  const Vec3 cloth = from_rgb(0x2F7A55) * (0.62 + 0.5 * broad + 0.14 * thread);
  const double facing = dot(out, towards_lamp());
  const double far = smooth_step(0.0, 8.5, length({p.x, p.y, 0}));
  return cloth * (kAmbient + kLamp * (facing * shadows_->lit(p, out))) * (1.0 - 0.5 * far);
}

Vec3 Cards::light(const Ray& ray, const Hit& hit) const {
  if (hit.shape == nullptr) return cloth_light(ray);
  const Vec3 p = ray.at(hit.t);
  const Vec3 own = hit.shape->local(p);
  const Vec3 side = hit.shape->normal(own);
  const Vec3 normal = dot(side, ray.direction) > 0 ? -side : side;
  const Vec3 paper = card_colour(faces_[hit.shape->material], own.x, own.y * kAspect, kAspect);
  const double facing = std::max(0.0, dot(normal, towards_lamp()));
  const double lit = facing > 0 ? shadows_->lit(p, normal) : 0.0;
  const Vec3 half_way = normalize(towards_lamp() - normalize(ray.direction));
  const double sheen = 0.10 * power_of_two_power(std::max(0.0, dot(half_way, normal)), 5);
  return paper * (kAmbient + kLamp * (facing * lit)) + kLamp * (sheen * lit);
}

}  // namespace

std::unique_ptr<Painter> make_cards(const SceneParams& params) {
  return std::make_unique<Cards>(params);
}

}  // namespace hmlfc::scenes
