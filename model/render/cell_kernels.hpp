// The displacements of a row of cells (docs/rendering.md, SRF-1 to SRF-3). The kernels are compiled
// once for each instruction set and chosen at run time; each equals the golden functions on every
// cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/format.hpp>

#include "render/row_kernels.hpp"
#include "render/surface.hpp"

namespace hmlfc {

/// For each cell of a row the block of plane Y that a view is looked up at.
struct CellBlocks {
  explicit CellBlocks(size_t cells) : bx(cells), by(cells) {}

  std::vector<int32_t> bx;
  std::vector<int32_t> by;
};

/// Answers of the views of a run of cells, in the order of their weights: for each view and cell
/// the disparity of the block that was looked up last, or kNoDisparity.
using ToldByViews = std::array<std::vector<int32_t>, Proposals::kMost>;

/// Where the cells of `run`, a run of `rays`, look up view `view` after it has told `told`, with
/// blocks of 2^log2 pixels: a step of SRF-3.
void locate_blocks(const FrameRecord& record, const RowRays& rays, const RayRun& run, ViewPos view,
                   unsigned log2, const std::vector<int32_t>& told, CellBlocks& blocks);

/// Writes E of the cells of `run` to their place in `cells`, a row, by what its views, whose
/// weights are found, tell.
void choose_displacements(const FrameRecord& record, const RayRun& run, const RunTaps& weights,
                          const ToldByViews& told, int32_t* cells);

}  // namespace hmlfc
