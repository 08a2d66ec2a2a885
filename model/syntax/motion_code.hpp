// What the encoder decides about motion: palettes of motion tiles and disparities (MOT-3, MOT-6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hmlfc {

/// One palette entry (MOT-3).
struct MotionSymbol {
  uint8_t reference_set = 0;  ///< [0, 7]
  uint8_t choice = 0;         ///< [0, 11] (MOT-5)
  bool negative = false;
  int16_t explicit_x = 0;  ///< with choices 10 and 11
  int16_t explicit_y = 0;  ///< with choice 11

  friend bool operator==(const MotionSymbol&, const MotionSymbol&) = default;
};

inline constexpr uint8_t kChoiceNone = 0;
inline constexpr uint8_t kChoiceOwn = 1;
inline constexpr uint8_t kFirstNeighbour = 2;
inline constexpr uint8_t kLastNeighbour = 9;
inline constexpr uint8_t kChoiceDisparity = 10;
inline constexpr uint8_t kChoiceVector = 11;
inline constexpr size_t kMaxPalette = 8;

/// What a motion tile of a predictive image says; the default where `empty`.
struct MotionTileCode {
  bool empty = true;
  unsigned block_log2 = 0;  ///< [2, 5]; the tile's own where empty
  std::vector<MotionSymbol> palette;
  std::vector<uint8_t> indices;  ///< of the motion blocks in the plane, row by row
};

/// Columns and rows of grid blocks to the neighbour of each choice (MOT-5).
inline constexpr std::array<std::array<int, 2>, 10> kChoiceMoves{
    {{0, 0}, {0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

/// The disparities of one reference group, one a grid block, row by row (MOT-6).
struct DisparityGrid {
  uint32_t blocks_x = 0;
  uint32_t blocks_y = 0;
  std::vector<int16_t> values;

  int16_t at(uint32_t x, uint32_t y) const { return values[size_t{y} * blocks_x + x]; }
};

}  // namespace hmlfc
