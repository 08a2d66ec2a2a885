// The displacements of a frame with geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace hmlfc
