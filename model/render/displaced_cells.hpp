// The displacements of a frame with geometry (SRF-1, SRF-3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

#include "render/disparity_cache.hpp"
#include "render/surface.hpp"

namespace hmlfc {

/// The displacement of each cell of a frame (SRF-1).
struct CellDisplacements {
  int32_t columns = 0;            ///< of cells
  std::vector<int32_t> cells;     ///< E, row by row; empty without geometry
  uint64_t blocks_looked_up = 0;  ///< SRF-5

  /// E of the cells of row `cj`, of a frame with geometry.
  const int32_t* row(int32_t cj) const { return cells.data() + ptrdiff_t{cj} * columns; }

  /// E of the cell of pixel (`i`, `j`); 0 without geometry.
  int32_t at(int32_t i, int32_t j) const {
    return cells.empty() ? 0 : row(j >> kCellLog2)[i >> kCellLog2];
  }
};

/// Those of the frame of `record` with `stop_level`, which fit the light field, from single blocks,
/// as docs/rendering.md, section 9, reads.
CellDisplacements golden_displacements(const Decoder& decoder, const FrameRecord& record,
                                       int stop_level);

/// The same from the maps of `cache`, which has begun a frame, in vectors of cells, into `found`,
/// whose memory is reused. Uses all threads of the caller's run_on_threads().
void find_displacements(const FrameRecord& record, int stop_level, unsigned block_log2,
                        DisparityCache& cache, CellDisplacements& found);

}  // namespace hmlfc
