#include "render/cell_displacements.hpp"

#include <map>
#include <tuple>

#include <hmlfc/disparity.hpp>

#include "bits/parallel.hpp"

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

}  // namespace

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

void find_displacements(const FrameRecord& record, int stop_level, unsigned block_log2,
                        DisparityCache& cache, CellDisplacements& found) {
  found.cells.clear();
  found.blocks_looked_up = 0;
  if (!has_geometry(record, stop_level)) return;
  found.columns = cells_along(record.frame_width);
  const auto rows = static_cast<size_t>(cells_along(record.frame_height));
  const auto columns = static_cast<size_t>(found.columns);
  found.cells.resize(columns * rows);
  parallel_for_parts(rows, kTaskCellRows, [&](size_t begin, size_t end) {
    MapLookup maps(cache);
    const auto look_up = [&](ViewPos view, uint32_t x, uint32_t y) {
      return maps.at(view).look_up(x >> block_log2, y >> block_log2);
    };
    for (size_t at = begin * columns; at < end * columns; ++at) {
      found.cells[at] = cell_displacement(record, static_cast<int32_t>(at % columns),
                                          static_cast<int32_t>(at / columns), look_up);
    }
  });
  found.blocks_looked_up = cache.blocks_looked_up();
}

}  // namespace hmlfc
