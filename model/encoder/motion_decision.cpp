#include "encoder/motion_decision.hpp"

#include <algorithm>
#include <numeric>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/cell_errors.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kMaxMotionLog2 = 5;

// Errors [symbol][block] of the motion blocks of one size in one tile. Those of a tile under one
// symbol add up to less than 2^30: at the coarsest quality an estimate is at most 10^6.
struct BlockErrors {
  uint32_t columns = 0;
  uint32_t rows = 0;
  std::vector<int32_t> errors;

  size_t count() const { return size_t{columns} * rows; }
};

// The cheapest palette of one tile with blocks of one size, built one symbol at a time, if its cost
// is below `most`.
class PaletteDecision {
 public:
  PaletteDecision(const BlockErrors& blocks, const std::vector<PaletteEntry>& symbols,
                  const PaletteFields& fields, Lambda lambda, int64_t most)
      : blocks_(blocks),
        symbols_(symbols),
        entry_bits_(palette_entry_bits(fields)),
        lambda_(lambda),
        count_(blocks.count()),
        least_(count_, (1 << 30) / static_cast<int32_t>(count_)),
        best_cost_(most) {}

  void run() {
    std::vector<int32_t> floor = least_;
    for (size_t s = 0; s < symbols_.size(); ++s) lower(floor, s);
    // One more symbol may pay only together with the next one, as level counts grow in steps: the
    // search goes on while symbols reduce the error, and all of them could.
    while (palette_.size() < std::min(kMaxPaletteEntries, symbols_.size())) {
      if (cost(floor, palette_.size() + 1) >= best_cost_ || !add_best()) break;
      const int64_t now = cost(least_, palette_.size());
      if (now < best_cost_) {
        best_cost_ = now;
        best_size_ = palette_.size();
      }
    }
  }

  int64_t cost() const { return best_cost_; }

  MotionTileCode tile(unsigned block_log2) const {
    MotionTileCode tile;
    tile.empty = false;
    tile.block_log2 = block_log2;
    for (size_t i = 0; i < best_size_; ++i) tile.palette.push_back(symbols_[palette_[i]]);
    for (size_t b = 0; b < count_; ++b) {
      size_t best = 0;
      for (size_t i = 1; i < best_size_; ++i) {
        if (errors(palette_[i])[b] < errors(palette_[best])[b]) best = i;
      }
      tile.indices.push_back(static_cast<uint8_t>(best));
    }
    return tile;
  }

 private:
  const int32_t* errors(size_t symbol) const { return &blocks_.errors[symbol * count_]; }

  bool add_best() {
    int32_t best_gain = 0;
    size_t best = symbols_.size();
    for (size_t s = 0; s < symbols_.size(); ++s) {
      const int32_t* of_symbol = errors(s);
      int32_t gain = 0;
      for (size_t b = 0; b < count_; ++b) gain += std::max(0, least_[b] - of_symbol[b]);
      if (gain <= best_gain) continue;
      best_gain = gain;
      best = s;
    }
    if (best == symbols_.size()) return false;
    palette_.push_back(best);
    lower(least_, best);
    return true;
  }

  void lower(std::vector<int32_t>& least, size_t symbol) const {
    const int32_t* of_symbol = errors(symbol);
    for (size_t b = 0; b < count_; ++b) least[b] = std::min(least[b], of_symbol[b]);
  }

  int64_t cost(const std::vector<int32_t>& errors, size_t entries) const {
    const auto size = static_cast<uint32_t>(entries);
    const auto bits = static_cast<int64_t>(kMotionHeadBits + size * entry_bits_ +
                                           bise_bits(levels_of_code(level_code_for(size)), count_));
    return lambda_.cost(std::accumulate(errors.begin(), errors.end(), int64_t{0}),
                        bits + kTileOverheadBits);
  }

  const BlockErrors& blocks_;
  const std::vector<PaletteEntry>& symbols_;
  unsigned entry_bits_;
  Lambda lambda_;
  size_t count_;
  std::vector<int32_t> least_;
  std::vector<size_t> palette_;
  int64_t best_cost_;
  size_t best_size_ = 0;
};

class TileDecision {
 public:
  TileDecision(const MotionTask& task, const std::vector<PaletteEntry>& symbols)
      : header_(task.sources.header),
        lambda_(task.lambda),
        fields_{task.sources.two_references(), !task.sources.keyed},
        grid_(task.sources.grid),
        symbols_(symbols),
        cell_errors_(task, symbols) {}

  MotionTileCode run(uint32_t tx, uint32_t ty) {
    MotionTileCode best;
    best.block_log2 = header_.motion_tile_log2;
    int64_t sum = 0;
    for_each_row(tx, ty, [&](uint32_t) { sum += cell_errors_.of_first_symbol(); });
    int64_t least = lambda_.cost(sum, 0);
    // Whatever the motion, a record costs as much.
    if (least <= lambda_.cost(0, kMotionHeadBits + palette_entry_bits(fields_) + kTileOverheadBits))
      return best;
    cells_.errors.resize(cells_.count() * symbols_.size());
    for_each_row(tx, ty, [&](uint32_t row) {
      cell_errors_.run(&cells_.errors[size_t{row} * cells_.columns], cells_.count());
    });
    const unsigned grid_log2 = header_.disparity_grid_log2;
    const unsigned last = std::min<unsigned>(kMaxMotionLog2, header_.motion_tile_log2);
    for (unsigned log2 = std::max<unsigned>(grid_log2, header_.block_log2); log2 <= last; ++log2) {
      const BlockErrors blocks = merged(log2 - grid_log2);
      PaletteDecision palette(blocks, symbols_, fields_, lambda_, least);
      palette.run();
      if (palette.cost() >= least) continue;
      least = palette.cost();
      best = palette.tile(log2);
    }
    return best;
  }

 private:
  // Calls work(row) with cell_errors_ at each row of cells of a tile.
  template <class Work>
  void for_each_row(uint32_t tx, uint32_t ty, const Work& work) {
    const uint32_t per_tile = 1u << (header_.motion_tile_log2 - header_.disparity_grid_log2);
    cells_.columns = std::min(per_tile, grid_.blocks_x - tx * per_tile);
    cells_.rows = std::min(per_tile, grid_.blocks_y - ty * per_tile);
    for (uint32_t j = 0; j < cells_.rows; ++j) {
      cell_errors_.go_to(tx * per_tile, ty * per_tile + j, cells_.columns);
      work(j);
    }
  }

  // Errors of blocks of 2^shift cells a side.
  BlockErrors merged(unsigned shift) const {
    BlockErrors blocks{
        ceil_div(cells_.columns, 1u << shift), ceil_div(cells_.rows, 1u << shift), {}};
    blocks.errors.resize(blocks.count() * symbols_.size());
    const int32_t* from = cells_.errors.data();
    for (size_t s = 0; s < symbols_.size(); ++s) {
      int32_t* to = &blocks.errors[s * blocks.count()];
      for (uint32_t j = 0; j < cells_.rows; ++j) {
        int32_t* row = to + size_t{j >> shift} * blocks.columns;
        for (uint32_t i = 0; i < cells_.columns; ++i) row[i >> shift] += *from++;
      }
    }
    return blocks;
  }

  const StreamHeader& header_;
  Lambda lambda_;
  PaletteFields fields_;
  const DisparityGrid& grid_;
  const std::vector<PaletteEntry>& symbols_;
  CellErrors cell_errors_;
  BlockErrors cells_;
};

}  // namespace

std::vector<MotionTileCode> decide_motion(const MotionTask& task) {
  const MotionPlaneShape& shape = task.sources.geometry.motion_planes()[0];
  const std::vector<PaletteEntry> symbols = candidate_symbols(task.sources, task.choices);
  std::vector<MotionTileCode> tiles(static_cast<size_t>(shape.tiles()));
  parallel_for(shape.tiles_y, [&](size_t ty) {
    TileDecision decision(task, symbols);
    for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
      tiles[ty * shape.tiles_x + tx] = decision.run(tx, static_cast<uint32_t>(ty));
    }
  });
  return tiles;
}

}  // namespace hmlfc
