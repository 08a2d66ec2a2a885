// Conformance levels (LVL-1 to LVL-3).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <hmlfc/format.hpp>

#include "syntax/header.hpp"

namespace hmlfc {

/// The greatest values that a level allows (LVL-1).
struct LevelLimits {
  uint32_t grid_side;    ///< rows and cols, each
  uint32_t view_side;    ///< width and height, each
  uint64_t view_pixels;  ///< width * height
  int depth;
  int window;
  int tree_height;
};

/// The table of LVL-1; index = level.
inline constexpr std::array<LevelLimits, 4> kLevelLimits{{
    {16, 256, 16384, 8, 31, 3},
    {64, 2048, uint64_t{1} << 21, 10, 63, 6},
    {256, 8192, uint64_t{1} << 25, 12, 127, 8},
    {kMaxGrid, kMaxSide, uint64_t{kMaxSide} * kMaxSide, 12, kMaxWindow, kMaxTreeHeight},
}};

/// The least level in [0, 3] whose limits `header`, which has passed check_fields, keeps (LVL-3).
constexpr int least_level(const StreamHeader& header) {
  const auto keeps = [&](const LevelLimits& limits) {
    return std::max(header.rows, header.cols) <= limits.grid_side &&
           std::max(header.width, header.height) <= limits.view_side &&
           uint64_t{header.width} * header.height <= limits.view_pixels &&
           header.depth <= limits.depth && header.window <= limits.window &&
           header.tree_height <= limits.tree_height;
  };
  size_t level = 0;
  while (!keeps(kLevelLimits[level])) ++level;
  return static_cast<int>(level);
}

}  // namespace hmlfc
