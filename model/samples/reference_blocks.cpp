#include "samples/reference_blocks.hpp"

#include <vector>

#include "values/rounding.hpp"

namespace hmlfc {

Result<BlockValues> gather_reference(ReferenceBlocks& blocks, const PlaneShape& plane,
                                     unsigned block_size, int32_t x, int32_t y) {
  const auto size = static_cast<int32_t>(block_size);
  const auto column = [&](int32_t i) {
    return static_cast<uint32_t>(clamp(x + i, 0, static_cast<int32_t>(plane.width) - 1));
  };
  const auto row = [&](int32_t j) {
    return static_cast<uint32_t>(clamp(y + j, 0, static_cast<int32_t>(plane.height) - 1));
  };
  const uint32_t first_bx = column(0) / block_size;
  const uint32_t first_by = row(0) / block_size;
  const uint32_t columns = column(size - 1) / block_size - first_bx + 1;
  const uint32_t rows = row(size - 1) / block_size - first_by + 1;

  std::vector<BlockValues> window;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      auto block = blocks.block(first_bx + i, first_by + j);
      if (!block) return tl::unexpected(block.error());
      window.push_back(*block);
    }
  }
  BlockValues gathered(block_size);
  for (int32_t j = 0; j < size; ++j) {
    for (int32_t i = 0; i < size; ++i) {
      const uint32_t sx = column(i);
      const uint32_t sy = row(j);
      const uint32_t which = (sy / block_size - first_by) * columns + (sx / block_size - first_bx);
      gathered.at(static_cast<unsigned>(i), static_cast<unsigned>(j)) =
          window[which].at(sx % block_size, sy % block_size);
    }
  }
  return gathered;
}

}  // namespace hmlfc
