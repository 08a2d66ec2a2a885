#include "render/displaced_cells.hpp"

#include <map>
#include <tuple>

#include <hmlfc/disparity.hpp>

#include "render/surface.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

// Reads what the blocks of plane Y of views tell, each once.
class ToldBlocks {
 public:
  explicit ToldBlocks(const Decoder& decoder) : decoder_(decoder) {}

  // Returns the disparity of the block that holds pixel (x, y) of `view`; of confidence 0 where it
  // has an error.
  const BlockDisparity& at(ViewPos view, int32_t x, int32_t y) {
    const unsigned log2 = decoder_.header().block_log2;
    const uint32_t bx = static_cast<uint32_t>(x) >> log2;
    const uint32_t by = static_cast<uint32_t>(y) >> log2;
    const auto [told, is_new] = told_.try_emplace({view.row, view.col, by, bx}, BlockDisparity{});
    if (is_new) {
      if (const auto disparity = block_disparity(decoder_, view, bx, by)) told->second = *disparity;
    }
    return told->second;
  }

  uint64_t count() const { return told_.size(); }

 private:
  const Decoder& decoder_;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>, BlockDisparity> told_;
};

// Returns what `view` proposes to the cell of `ray` (SRF-3).
int32_t proposed(const FrameRecord& f, const Ray& ray, ViewPos view, ToldBlocks& told) {
  int32_t e = 0;
  for (int step = 0; step < kDisplacementSteps; ++step) {
    const int32_t g = displacement_a_row(e, f.pitch);
    const int32_t x = nearest_pixel(x_in_view(f, ray, e, static_cast<int32_t>(view.col)), f.width);
    const int32_t y = nearest_pixel(y_in_view(f, ray, g, static_cast<int32_t>(view.row)), f.height);
    e = displacement_of(told.at(view, x, y), f);
  }
  return e;
}

// E of cell (`ci`, `cj`).
int32_t displacement_of_cell(const FrameRecord& f, int32_t ci, int32_t cj, ToldBlocks& told) {
  const auto ray =
      trace(f, direction(f, ray_of_cell(ci, f.frame_width), ray_of_cell(cj, f.frame_height)));
  if (!ray) return 0;
  const GridWeights rows(axis_weights(f, ray->v), f.rows);
  const GridWeights cols(axis_weights(f, ray->u), f.cols);
  Proposals proposals;
  for (int32_t row = rows.first(); row <= rows.last(); ++row) {
    for (int32_t col = cols.first(); col <= cols.last(); ++col) {
      const ViewPos view{static_cast<uint32_t>(row), static_cast<uint32_t>(col)};
      proposals.add(proposed(f, *ray, view, told), rows.weight(row) * cols.weight(col));
    }
  }
  return proposals.chosen();
}

}  // namespace

CellDisplacements golden_displacements(const Decoder& decoder, const FrameRecord& record,
                                       int stop_level) {
  CellDisplacements found;
  if (!has_geometry(record, stop_level)) return found;
  ToldBlocks told(decoder);
  found.columns = cells_along(record.frame_width);
  for (int32_t cj = 0; cj < cells_along(record.frame_height); ++cj) {
    for (int32_t ci = 0; ci < found.columns; ++ci) {
      found.cells.push_back(displacement_of_cell(record, ci, cj, told));
    }
  }
  found.blocks_looked_up = told.count();
  return found;
}

}  // namespace hmlfc
