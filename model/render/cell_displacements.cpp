#include "render/displaced_cells.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "bits/parallel.hpp"
#include "render/cell_kernels.hpp"

namespace hmlfc {
namespace {

// Rows of cells of a task.
constexpr size_t kTaskCellRows = 4;

// The maps of one frame by the places of their views, for one thread: keeps the last ones, since
// those in the cache take a lock.
class MapLookup {
 public:
  explicit MapLookup(DisparityCache& cache) : cache_(cache) {}

  ViewDisparities& at(ViewPos view) {
    Entry& entry = entries_[view.row % kSide * kSide + view.col % kSide];
    if (entry.map == nullptr || entry.view.row != view.row || entry.view.col != view.col)
      entry = {view, &cache_.use(view)};
    return *entry.map;
  }

 private:
  static constexpr uint32_t kSide = 4;

  struct Entry {
    ViewPos view;
    ViewDisparities* map = nullptr;
  };

  DisparityCache& cache_;
  std::array<Entry, size_t{kSide} * kSide> entries_;
};

// Finds rows of cells for one task.
class CellRows {
 public:
  CellRows(const FrameRecord& record, unsigned block_log2, DisparityCache& cache)
      : record_(record),
        block_log2_(block_log2),
        maps_(cache),
        rays_(static_cast<size_t>(cells_along(record.frame_width))),
        weights_(static_cast<size_t>(cells_along(record.frame_width))),
        blocks_(static_cast<size_t>(cells_along(record.frame_width))) {
    for (auto& told : told_) told.resize(static_cast<size_t>(cells_along(record.frame_width)));
  }

  // Writes E of the cells of row `cj`, which are 0, to `cells`.
  void find(int32_t cj, int32_t* cells) {
    trace_row(record_, row_of_cells(record_, cj), rays_);
    for (const RayRun& run : rays_.runs()) {
      find_weights(record_, rays_, run, weights_);
      size_t view = 0;
      for (int32_t row = run.first_row; row <= run.last_row; ++row) {
        for (int32_t col = run.first_col; col <= run.last_col; ++col) {
          ask({static_cast<uint32_t>(row), static_cast<uint32_t>(col)}, run, told_[view++]);
        }
      }
      choose_displacements(record_, run, weights_, told_, cells);
    }
  }

 private:
  // Finds what `view` proposes to the cells of `run`.
  void ask(ViewPos view, const RayRun& run, std::vector<int32_t>& told) {
    const auto begin = static_cast<size_t>(run.begin);
    const auto cells = static_cast<size_t>(run.end - run.begin);
    const auto part = [&](std::vector<int32_t>& row) {
      return std::span(row).subspan(begin, cells);
    };
    std::ranges::fill(part(told), kNoDisparity);
    for (int step = 0; step < kDisplacementSteps; ++step) {
      locate_blocks(record_, rays_, run, view, block_log2_, told, blocks_);
      maps_.at(view).look_up(part(blocks_.bx), part(blocks_.by), part(told));
    }
  }

  const FrameRecord& record_;
  unsigned block_log2_;
  MapLookup maps_;
  RowRays rays_;
  RunTaps weights_;  // without taps
  CellBlocks blocks_;
  ToldByViews told_;
};

}  // namespace

void find_displacements(const FrameRecord& record, int stop_level, unsigned block_log2,
                        DisparityCache& cache, CellDisplacements& found) {
  found.cells.clear();
  found.blocks_looked_up = 0;
  if (!has_geometry(record, stop_level)) return;
  found.columns = cells_along(record.frame_width);
  const auto rows = static_cast<size_t>(cells_along(record.frame_height));
  found.cells.resize(static_cast<size_t>(found.columns) * rows);
  parallel_for_parts(rows, kTaskCellRows, [&](size_t begin, size_t end) {
    CellRows finder(record, block_log2, cache);
    for (size_t cj = begin; cj < end; ++cj) {
      finder.find(static_cast<int32_t>(cj),
                  found.cells.data() + cj * static_cast<size_t>(found.columns));
    }
  });
  found.blocks_looked_up = cache.blocks_looked_up();
}

}  // namespace hmlfc
