// The printed sides of the cards and panels of scene "cards".
#pragma once

#include <cstdint>

#include "scenes/vec3.hpp"

namespace hmlfc::scenes {

enum class Print : uint32_t { kFace, kBack, kChecker, kStripes, kMarble, kDots };

/// The print of one sheet.
struct CardFace {
  Print print = Print::kFace;
  uint32_t rank = 1;  ///< of a face, [1, 10]
  uint32_t suit = 0;  ///< of a face, [0, 3]: heart, spade, diamond, club
  Vec3 ink{1, 1, 1};  ///< main colour of the other prints
  uint64_t seed = 0;
};

/// Reflectance of a card of half size 1 x `aspect` at (x, y), y upwards; |x| <= 1, |y| <= aspect.
Vec3 card_colour(const CardFace& face, double x, double y, double aspect);

}  // namespace hmlfc::scenes
