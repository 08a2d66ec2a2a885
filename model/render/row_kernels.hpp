// The rays, taps and samples of a row of a frame. The kernels are the renderer's inner loops,
// compiled once for each instruction set and chosen at run time; each equals the golden functions
// on every pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/camera.hpp>

#include "bits/exact_floats.hpp"
#include "render/displaced_cells.hpp"
#include "render/taps.hpp"

namespace hmlfc {

/// Pixels [begin, end) of a row, all inside, with weights for the same views.
struct RayRun {
  int32_t begin = 0;
  int32_t end = 0;
  int32_t first_col = 0;  ///< views with a weight: [first_col, last_col] x [first_row, last_row]
  int32_t last_col = 0;
  int32_t first_row = 0;
  int32_t last_row = 0;
};

/// A row of rays: those of RAY-1 at b and at a, a + step and so on, but at `last` at most.
struct RayRow {
  int32_t count;  ///< [1, 4096]
  int32_t a;
  int32_t step;
  int32_t last;
  int32_t b;

  /// a of ray `i`.
  constexpr int32_t a_of(int32_t i) const { return std::min(a + step * i, last); }
};

/// Returns the rays of pixel row `j`.
constexpr RayRow row_of_pixels(const FrameRecord& f, int32_t j) {
  return {f.frame_width, 1 - f.frame_width, 2, f.frame_width - 1, 2 * j + 1 - f.frame_height};
}

/// Returns the rays of cell row `cj` (SRF-1).
constexpr RayRow row_of_cells(const FrameRecord& f, int32_t cj) {
  return {cells_along(f.frame_width), 4 - f.frame_width, 8, f.frame_width - 1,
          ray_of_cell(cj, f.frame_height)};
}

/// The rays of a row, of pixels or of cells, which are called pixels here; outside the
/// runs they have no meaning. Equal to trace() on each.
struct RowRays {
  static constexpr int32_t kOutside = -1;  ///< u of pixels that are outside

  /// Room for `pixels` pixels and those that vectors write after them.
  explicit RowRays(size_t pixels)
      : u(pixels + kSpare),
        v(pixels + kSpare),
        us(pixels + kSpare),
        vs(pixels + kSpare),
        xb(pixels + kSpare),
        yb(pixels + kSpare),
        view_keys(pixels),
        e(pixels) {
    all_runs.reserve(pixels);
  }

  static constexpr size_t kSpare = 64;

  std::vector<int32_t> u;
  std::vector<int32_t> v;
  std::vector<int32_t> us;  ///< in records with geometry alone, like vs
  std::vector<int32_t> vs;
  std::vector<int32_t> xb;
  std::vector<int32_t> yb;
  std::vector<int32_t> view_keys;  ///< scratch of trace_row()

  /// Whether the row has the columns of the row traced before it: u, us, xb, and the pixels and
  /// columns of views of its runs.
  bool same_columns = false;
  bool inside = true;  ///< whether any pixel is
  std::vector<RayRun> all_runs;

  bool displaced = false;   ///< whether the frame has geometry
  std::vector<int32_t> e;   ///< then the displacement of each pixel's cell
  int32_t cells_of_e = -1;  ///< and the row of cells that they are of

  /// The runs of the row, from left to right.
  std::span<const RayRun> runs() const {
    return inside ? std::span<const RayRun>(all_runs) : std::span<const RayRun>();
  }

  /// Sets the displacements of row `j` of a frame.
  void displace(const CellDisplacements& cells, int32_t j) {
    displaced = !cells.cells.empty();
    if (!displaced || cells_of_e == j >> kCellLog2) return;
    cells_of_e = j >> kCellLog2;
    const int32_t* row = cells.row(cells_of_e);
    for (size_t i = 0; i < e.size(); ++i) e[i] = row[i >> kCellLog2];
  }
};

/// One axis of a run: for each view of the axis and each pixel of the row its taps (SMP-2) and its
/// weight (SMP-1). Only the run's pixels are set, and kSpare first taps after them.
struct AxisRun {
  explicit AxisRun(size_t row_pixels) : array_size_(row_pixels + kSpare) {}

  /// Elements that vectors read after the last pixel.
  static constexpr size_t kSpare = 4;

  /// Pixel weights of a tap whose second pixel is not read.
  static constexpr int32_t kFirstAlone = 256;

  int32_t first_view = 0;
  int32_t views = 0;  ///< [1, kMaxAxisViews]

  /// Of view first_view + k: the first tap of each pixel; the weight of this tap in the lower and
  /// that of the second tap in the upper 16 bits, of 256; the weight of the view.
  std::vector<int32_t> first[kMaxAxisViews];
  std::vector<int32_t> pixel_weights[kMaxAxisViews];
  std::vector<int32_t> weight[kMaxAxisViews];
  std::vector<int32_t> places;  ///< of displaced pixels in one view, in between

  /// The last pixel that a tap of pixel `i` reads in view first_view + k.
  int32_t last(int32_t k, int32_t i) const {
    const auto at = static_cast<size_t>(i);
    return first[k][at] + (pixel_weights[k][at] != kFirstAlone ? 1 : 0);
  }

  /// Makes views [first, last] those of the axis.
  void choose(int32_t first_of_axis, int32_t last_of_axis) {
    first_view = first_of_axis;
    views = last_of_axis - first_of_axis + 1;
    places.resize(array_size_);
    for (int32_t k = 0; k < views; ++k) {
      if (!first[k].empty()) continue;
      for (auto* array : {&first[k], &pixel_weights[k], &weight[k]}) array->resize(array_size_);
    }
  }

 private:
  size_t array_size_;
};

/// Both axes of a run.
struct RunTaps {
  explicit RunTaps(size_t row_pixels) : cols(row_pixels), rows(row_pixels) {}

  /// Makes the views of `run` those of the axes.
  void choose(const RayRun& run) {
    cols.choose(run.first_col, run.last_col);
    rows.choose(run.first_row, run.last_row);
  }

  AxisRun cols;
  AxisRun rows;
};

/// The rays of `row`, and their runs. The rows before in `rays` differ in b alone.
void trace_row(const FrameRecord& record, const RayRow& row, RowRays& rays);

/// The taps of `run` in all its views: axis_taps() of each pixel, displaced where the row is.
/// `taps` has those of all runs of the row traced before, if any, as in find_weights().
void find_taps(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps);

/// The weights of the views of `run`, which are those of `taps`: GridWeights of each pixel.
void find_weights(const FrameRecord& record, const RowRays& rays, const RayRun& run, RunTaps& taps);

/// The number of pixels of views that the run's pixels read.
uint64_t count_reads(const RayRun& run, const RunTaps& taps);

/// Whether the first taps of view `k` of `axis` (AxisRun) only rise along a run, or only fall, by
/// at most `step` from pixel to pixel.
bool is_steady(const AxisRun& axis, int32_t k, const RayRun& run, int32_t step);

/// Finds where along a run the blocks of 2^log2 pixels change that the taps of view `k` of `axis`
/// read: writes these pixels to `steps`, always with the run's first, and returns their number.
/// `steps` has room for the run and one more.
int32_t find_steps(const AxisRun& axis, int32_t k, const RayRun& run, unsigned log2,
                   int32_t* steps);

/// The pixels of the views of a run in memory.
struct RunViews {
  bool two_bytes = false;  ///< a sample
  /// CachedView::rows() of the views, row by row; those of the run's rows and columns of views.
  std::array<const uint8_t* const*, size_t{kMaxAxisViews} * kMaxAxisViews> rows;
};

/// Writes the samples R, G, B of the pixels of `run` (SMP-2, SMP-3), whose taps and weights are
/// found, to `out`, and anything to kRowSpare samples after them. `interpolated`: pixels of views
/// are, as with filter quadrilinear.
void sample_run(const RayRun& run, const RunTaps& taps, const RunViews& views, bool interpolated,
                uint16_t* out);
inline constexpr size_t kRowSpare = 16;

}  // namespace hmlfc
