#include "render/cell_displacements.hpp"

#include <map>
#include <tuple>

#include <hmlfc/disparity.hpp>

namespace hmlfc {

CellDisplacements golden_displacements(const Decoder& decoder, const FrameRecord& record,
                                       int stop_level) {
  CellDisplacements found;
  if (!has_geometry(record, stop_level)) return found;
  const unsigned log2 = decoder.header().block_log2;
  using Block = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>;
  std::map<Block, BlockDisparity> told;  // of each block that is looked up
  const auto look_up = [&](ViewPos view, uint32_t x, uint32_t y) {
    const auto [at, is_new] =
        told.try_emplace({view.row, view.col, y >> log2, x >> log2}, BlockDisparity{});
    if (is_new) {
      const auto disparity = block_disparity(decoder, view, x >> log2, y >> log2);
      if (disparity) at->second = *disparity;
    }
    return at->second;
  };
  found.columns = cells_along(record.frame_width);
  for (int32_t cj = 0; cj < cells_along(record.frame_height); ++cj) {
    for (int32_t ci = 0; ci < found.columns; ++ci) {
      found.cells.push_back(cell_displacement(record, ci, cj, look_up));
    }
  }
  found.blocks_looked_up = told.size();
  return found;
}

}  // namespace hmlfc
