// The displacement of each cell of a frame with geometry (SRF-1, SRF-3): golden, from single
// blocks, and fast, from maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

#include "render/disparity_cache.hpp"
#include "render/displaced_cells.hpp"
#include "render/surface.hpp"
#include "render/taps.hpp"

namespace hmlfc {

/// The ray through the middle of cell (`ci`, `cj`); nothing if it is outside (SRF-1).
constexpr std::optional<Ray> trace_cell(const FrameRecord& f, int32_t ci, int32_t cj) {
  return trace(f, direction(f, 8 * ci + 4 - f.frame_width, 8 * cj + 4 - f.frame_height));
}

/// E of cell (`ci`, `cj`) (SRF-3). `look_up(ViewPos, x, y)` gives the BlockDisparity of the block
/// of plane Y that holds pixel (x, y) of a view, of confidence 0 where it has an error.
template <class LookUp>
int32_t cell_displacement(const FrameRecord& f, int32_t ci, int32_t cj, const LookUp& look_up) {
  const auto ray = trace_cell(f, ci, cj);
  if (!ray) return 0;
  const GridWeights rows(axis_weights(f, ray->v), f.rows);
  const GridWeights cols(axis_weights(f, ray->u), f.cols);
  Proposals proposals;
  for (int32_t row = rows.first(); row <= rows.last(); ++row) {
    for (int32_t col = cols.first(); col <= cols.last(); ++col) {
      const ViewPos view{static_cast<uint32_t>(row), static_cast<uint32_t>(col)};
      int32_t e = 0;
      for (int step = 0; step < kDisplacementSteps; ++step) {
        const int32_t g = displacement_a_row(e, f.pitch);
        const int32_t x = nearest_pixel(x_in_view(f, *ray, e, col), f.width);
        const int32_t y = nearest_pixel(y_in_view(f, *ray, g, row), f.height);
        e = displacement_of(look_up(view, static_cast<uint32_t>(x), static_cast<uint32_t>(y)),
                            f.focus);
      }
      proposals.add(e, rows.weight(row) * cols.weight(col));
    }
  }
  return proposals.chosen();
}

/// Those of the frame of `record` with `stop_level`, which fit the light field, by the disparities
/// of single blocks.
CellDisplacements golden_displacements(const Decoder& decoder, const FrameRecord& record,
                                       int stop_level);

/// The same by the maps of `cache`, which has begun a frame, into `found`, whose memory is reused.
/// Uses all threads of the caller's run_on_threads().
void find_displacements(const FrameRecord& record, int stop_level, unsigned block_log2,
                        DisparityCache& cache, CellDisplacements& found);

}  // namespace hmlfc
