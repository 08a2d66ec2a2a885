#include "decoder/reference_blocks.hpp"

#include <vector>

#include "arithmetic/rounding.hpp"

namespace hmlfc {

Result<ReferenceWindow> gather_reference(ReferenceBlocks& blocks, const PlaneShape& plane,
                                         unsigned block_size, const ReferenceArea& area) {
  const auto column = [&](unsigned i) {
    const int32_t last = static_cast<int32_t>(plane.width) - 1;
    return static_cast<uint32_t>(clamp(area.x + static_cast<int32_t>(i), 0, last));
  };
  const auto row = [&](unsigned j) {
    const int32_t last = static_cast<int32_t>(plane.height) - 1;
    return static_cast<uint32_t>(clamp(area.y + static_cast<int32_t>(j), 0, last));
  };
  const uint32_t first_bx = column(0) / block_size;
  const uint32_t first_by = row(0) / block_size;
  const uint32_t columns = column(area.columns - 1) / block_size - first_bx + 1;
  const uint32_t rows = row(area.rows - 1) / block_size - first_by + 1;

  std::vector<BlockValues> touched;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      auto block = blocks.block(first_bx + i, first_by + j);
      if (!block) return tl::unexpected(block.error());
      touched.push_back(*block);
    }
  }
  ReferenceWindow window(area.columns, area.rows);
  for (unsigned j = 0; j < area.rows; ++j) {
    for (unsigned i = 0; i < area.columns; ++i) {
      const uint32_t sx = column(i);
      const uint32_t sy = row(j);
      const uint32_t which = (sy / block_size - first_by) * columns + (sx / block_size - first_bx);
      window.at(i, j) = touched[which].at(sx % block_size, sy % block_size);
    }
  }
  return window;
}

}  // namespace hmlfc
