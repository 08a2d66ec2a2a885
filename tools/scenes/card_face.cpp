#include "scenes/card_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "scenes/hash_noise.hpp"
#include "scenes/tone.hpp"

namespace hmlfc::scenes {
namespace {

constexpr Vec3 kPaper = from_rgb(0xEFEADC);
constexpr Vec3 kBlack = from_rgb(0x1B1D22);
constexpr Vec3 kRed = from_rgb(0xC21F2B);

struct Place {
  double x;
  double y;
};

constexpr bool in_disc(double x, double y, double cx, double cy, double radius) {
  return (x - cx) * (x - cx) + (y - cy) * (y - cy) <= radius * radius;
}

// The pip of each suit, in [-1, 1]^2, y upwards.

bool in_heart(double x, double y) {
  const double side = std::abs(x);
  if (in_disc(side, y, 0.46, 0.38, 0.5)) return true;
  return y <= 0.62 && y >= -0.95 && side <= 0.62 * (y + 0.95) && side <= 0.87 && y < 0.45;
}

bool in_stem(double x, double y) {
  return y <= -0.2 && y >= -0.95 && std::abs(x) <= 0.08 + 0.35 * (0.2 + y) * (0.2 + y);
}

bool in_spade(double x, double y) { return in_heart(x, -y * 1.2 + 0.18) || in_stem(x, y); }

bool in_diamond(double x, double y) { return std::abs(x) * 1.35 + std::abs(y) <= 1.0; }

bool in_club(double x, double y) {
  return in_disc(x, y, 0, 0.48, 0.44) || in_disc(std::abs(x), y, 0.48, -0.18, 0.44) ||
         in_disc(x, y, 0, 0.05, 0.25) || in_stem(x, y);
}

bool in_suit(uint32_t suit, double x, double y) {
  constexpr bool (*kSuits[])(double x, double y) = {in_heart, in_spade, in_diamond, in_club};
  return kSuits[suit](x, y);
}

/// Positions of the pips of ranks 1 to 10, in units of the printed area.
std::span<const Place> pip_places(uint32_t rank) {
  static constexpr std::array<Place, 55> kPlaces = {{
      {0, 0},                                                                               // 1
      {0, .7},     {0, -.7},                                                                // 2
      {0, .7},     {0, 0},     {0, -.7},                                                    // 3
      {-.6, .7},   {.6, .7},   {-.6, -.7}, {.6, -.7},                                       // 4
      {-.6, .7},   {.6, .7},   {0, 0},     {-.6, -.7}, {.6, -.7},                           // 5
      {-.6, .7},   {.6, .7},   {-.6, 0},   {.6, 0},    {-.6, -.7},  {.6, -.7},              // 6
      {-.6, .7},   {.6, .7},   {-.6, 0},   {.6, 0},    {-.6, -.7},  {.6, -.7},   {0, .35},  // 7
      {-.6, .7},   {.6, .7},   {-.6, 0},   {.6, 0},    {-.6, -.7},  {.6, -.7},   {0, .35},
      {0, -.35},   {-.6, .75}, {.6, .75},  {-.6, .25}, {.6, .25},   {-.6, -.25}, {.6, -.25},
      {-.6, -.75}, {.6, -.75}, {0, 0},  // 9
      {-.6, .75},  {.6, .75},  {-.6, .25}, {.6, .25},  {-.6, -.25}, {.6, -.25},  {-.6, -.75},
      {.6, -.75},  {0, .5},    {0, -.5},  // 10
  }};
  return std::span(kPlaces).subspan(rank * (rank - 1) / 2, rank);
}

/// Rows of 5 pixels, top first, of A 2 3 ... 9 and of 10 (narrow digits).
constexpr std::array<std::array<uint8_t, 7>, 10> kGlyphs = {{
    {0x04, 0x0A, 0x11, 0x11, 0x1F, 0x11, 0x11},
    {0x0E, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1F},
    {0x0E, 0x11, 0x01, 0x06, 0x01, 0x11, 0x0E},
    {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02},
    {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E},
    {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E},
    {0x1F, 0x01, 0x02, 0x04, 0x04, 0x08, 0x08},
    {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E},
    {0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C},
    {0x17, 0x15, 0x15, 0x15, 0x15, 0x15, 0x17},
}};

/// The rank's glyph, in [-1, 1]^2, y upwards.
bool in_glyph(uint32_t rank, double x, double y) {
  if (std::abs(x) >= 1.0 || std::abs(y) >= 1.0) return false;
  const auto column = static_cast<unsigned>((x + 1.0) * 2.5);
  const auto row = static_cast<unsigned>((1.0 - y) * 3.5);
  return (kGlyphs[rank - 1][row] >> (4 - column) & 1) != 0;
}

bool in_corner_index(const CardFace& face, double x, double y, double aspect) {
  const double right = x + 0.82;
  const double up = y - (aspect - 0.24);
  return in_glyph(face.rank, right / 0.085, up / 0.125) ||
         in_suit(face.suit, right / 0.1, (up + 0.25) / 0.1);
}

/// Distance outwards from the card's straight edges, negative inside.
double edge_margin(double x, double y, double aspect) {
  return std::max(std::abs(x) - 1.0, std::abs(y) - aspect);
}

Vec3 face_colour(const CardFace& face, double x, double y, double aspect) {
  const Vec3 ink = face.suit % 2 == 0 ? kRed : kBlack;
  if (edge_margin(x, y, aspect) > -0.022) return kPaper * 0.55;
  if (in_corner_index(face, x, y, aspect) || in_corner_index(face, -x, -y, aspect)) return ink;
  const double size = face.rank == 1 ? 0.42 : 0.19;
  for (const Place& place : pip_places(face.rank)) {
    const double right = (x - place.x * 0.72) / size;
    const double up = (y - place.y * (aspect - 0.28)) / size;
    if (std::abs(right) > 1.0 || std::abs(up) > 1.0) continue;
    if (in_suit(face.suit, right, place.y < 0 ? -up : up)) return ink;
  }
  return kPaper;
}

/// A lattice of rhombs in a frame.
Vec3 back_colour(const CardFace& face, double x, double y, double aspect) {
  const double margin = edge_margin(x, y, aspect);
  if (margin > -0.022) return kPaper * 0.55;
  if (margin > -0.1) return kPaper;
  if (margin > -0.14) return face.ink;
  if (margin > -0.17) return kPaper;
  const double a = fraction((x + y) * 3.5) - 0.5;
  const double b = fraction((x - y) * 3.5) - 0.5;
  if (std::abs(a) > 0.43 || std::abs(b) > 0.43) return kPaper;
  return a * a + b * b < 0.022 ? kPaper : face.ink;
}

Vec3 checker_colour(const CardFace& face, double x, double y) {
  const int64_t cells = floor_to_int(x * 4.0) + floor_to_int(y * 4.0);
  return (cells & 1) != 0 ? face.ink : kPaper;
}

Vec3 stripes_colour(const CardFace& face, double x, double y) {
  const double band = fraction((x + 0.5 * y) * 2.5);
  const Vec3 second = mix(kPaper, face.ink, 0.35);
  return band < 0.5 ? face.ink : (band < 0.75 ? kPaper : second);
}

Vec3 marble_colour(const CardFace& face, double x, double y) {
  const double warp = layered_noise(face.seed, x * 1.7, y * 1.7, 3);
  const double vein = fraction(x * 0.9 + y * 0.6 + 2.2 * warp);
  const double ridge = std::abs(vein - 0.5) * 2.0;
  const double grain = layered_noise(face.seed + 9, x * 7.0, y * 7.0, 2);
  return mix(face.ink, kPaper, smooth_step(0.05, 0.6, ridge)) * (0.85 + 0.15 * grain);
}

Vec3 dots_colour(const CardFace& face, double x, double y) {
  const int64_t row = floor_to_int(y * 4.0);
  const double shifted = x * 4.0 + ((row & 1) != 0 ? 0.5 : 0.0);
  const double right = fraction(shifted) - 0.5;
  const double up = fraction(y * 4.0) - 0.5;
  return right * right + up * up < 0.09 ? kPaper : face.ink;
}

}  // namespace

Vec3 card_colour(const CardFace& face, double x, double y, double aspect) {
  switch (face.print) {
    case Print::kFace:
      return face_colour(face, x, y, aspect);
    case Print::kBack:
      return back_colour(face, x, y, aspect);
    case Print::kChecker:
      return checker_colour(face, x, y);
    case Print::kStripes:
      return stripes_colour(face, x, y);
    case Print::kMarble:
      return marble_colour(face, x, y);
    case Print::kDots:
      break;
  }
  return dots_colour(face, x, y);
}

}  // namespace hmlfc::scenes
