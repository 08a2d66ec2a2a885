// From linear light to the samples of a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scenes/vec3.hpp"

namespace hmlfc::scenes {

/// round(sqrt(light) * (2^depth - 1)), light clamped to [0, 1]: a gamma of 2, close to sRGB's
/// and exact on every machine.
inline uint16_t to_sample(double light, int depth) {
  const double greatest = (1 << depth) - 1;
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and lround is slow
  return static_cast<uint16_t>(std::sqrt(std::clamp(light, 0.0, 1.0)) * greatest + 0.5);
}

inline void store(Vec3 light, int depth, uint16_t* pixel) {
  pixel[0] = to_sample(light.x, depth);
  pixel[1] = to_sample(light.y, depth);
  pixel[2] = to_sample(light.z, depth);
}

/// The linear colour of an sRGB-like value of 8 bits per channel, 0xRRGGBB.
constexpr Vec3 from_rgb(uint32_t rgb) {
  const double red = (rgb >> 16 & 0xFFu) / 255.0;
  const double green = (rgb >> 8 & 0xFFu) / 255.0;
  const double blue = (rgb & 0xFFu) / 255.0;
  return {red * red, green * green, blue * blue};
}

}  // namespace hmlfc::scenes
