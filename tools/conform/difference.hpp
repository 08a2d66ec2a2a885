// Where decoded views differ from the golden model's.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc::conform {

/// The first wrong block, views row by row and blocks of plane Y row by row in each, with its first
/// wrong sample; and how much is wrong in all.
struct Difference {
  ViewPos view;
  uint32_t block_x = 0;  ///< block of plane Y
  uint32_t block_y = 0;
  uint32_t x = 0;  ///< pixel of the view
  uint32_t y = 0;
  char channel = 'R';
  int expected = 0;
  int actual = 0;
  std::vector<Plane> planes;  ///< planes of YCoCg (COL-1) in which the block's pixels differ
  uint64_t wrong_blocks = 0;  ///< of all views
  uint64_t blocks = 0;
  uint64_t wrong_views = 0;
};

/// The blocks of one view and how wrong each is.
struct BlockMap {
  uint32_t columns = 0;
  uint32_t rows = 0;
  std::vector<uint16_t> worst;  ///< the largest difference of a sample, 0: equal; row by row
};

/// Compares two views of one size block by block of `block_size` pixels.
BlockMap compare_blocks(const RgbImage& expected, const RgbImage& actual, unsigned block_size);

/// Compares all views; nothing where they are equal. `maps` gets the blocks of each view.
std::optional<Difference> first_difference(const std::vector<RgbImage>& expected,
                                           const std::vector<RgbImage>& actual, uint32_t cols,
                                           unsigned block_size, std::vector<BlockMap>& maps);

/// "view 0,1 block 3,2 (pixel 13,9 G): 17 instead of 18; planes Y, Cg; 4 of 96 blocks in 2 views".
std::string to_string(const Difference& difference);

}  // namespace hmlfc::conform
