// The order of blocks in a tile, masks of borders, widths that follow from the window (TIL-2,
// TIL-3, TIL-6).
#include "syntax/tile_record.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"

namespace hmlfc {
namespace {

struct Place {
  unsigned i, j;
};

// Quads of 2 x 2 blocks row by row, in each its blocks row by row: listed.
std::vector<Place> listed_blocks() {
  std::vector<Place> places;
  for (unsigned quad_row = 0; quad_row < 4; ++quad_row) {
    for (unsigned quad_col = 0; quad_col < 4; ++quad_col) {
      for (unsigned row = 0; row < 2; ++row) {
        for (unsigned col = 0; col < 2; ++col) {
          places.push_back({2 * quad_col + col, 2 * quad_row + row});
        }
      }
    }
  }
  return places;
}

TEST(TileLayout, BlockNumbers) {
  const auto places = listed_blocks();
  for (unsigned k = 0; k < 64; ++k) {
    EXPECT_EQ(block_number(places[k].i, places[k].j), k);
    EXPECT_EQ(block_column(k), places[k].i);
    EXPECT_EQ(block_row(k), places[k].j);
  }
  EXPECT_EQ(block_number(3, 2), 21u);
}

// A block lies in the plane if its first sample does.
TEST(TileLayout, BlocksInsideForEveryBorder) {
  const auto places = listed_blocks();
  for (uint32_t blocks_x = 1; blocks_x <= 17; ++blocks_x) {
    for (uint32_t blocks_y = 1; blocks_y <= 17; ++blocks_y) {
      PlaneShape plane;
      plane.blocks_x = blocks_x;
      plane.blocks_y = blocks_y;
      for (uint32_t ty = 0; 8 * ty < blocks_y; ++ty) {
        for (uint32_t tx = 0; 8 * tx < blocks_x; ++tx) {
          const uint64_t mask = blocks_inside(plane, tx, ty);
          for (unsigned k = 0; k < 64; ++k) {
            const bool inside = 8 * tx + places[k].i < blocks_x && 8 * ty + places[k].j < blocks_y;
            ASSERT_EQ((mask >> k) % 2 != 0, inside)
                << "block " << k << " of tile " << tx << ", " << ty;
          }
        }
      }
    }
  }
}

TEST(TileLayout, VectorWidthsOfEveryWindow) {
  for (int window = 0; window <= 127; ++window) {
    const unsigned values = 2 * static_cast<unsigned>(window) + 1;
    unsigned v = 0;
    while ((1u << v) < values) ++v;
    unsigned K = 0;
    while (levels_of_code(K).count < values) ++K;
    unsigned c = 0;
    while ((1u << c) <= K) ++c;
    const VectorWidths widths = vector_widths(window);
    EXPECT_EQ(widths.component_bits, v) << window;
    EXPECT_EQ(widths.max_code, K) << window;
    EXPECT_EQ(widths.code_bits, c) << window;
  }
  EXPECT_EQ(vector_widths(0).component_bits + vector_widths(0).code_bits, 0u);
}

}  // namespace
}  // namespace hmlfc
