#include "encoder/motion_decision.hpp"

#include <algorithm>
#include <limits>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/cell_errors.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kMaxMotionLog2 = 5;

// Errors [block][symbol] of the motion blocks of one size in one tile.
struct BlockErrors {
  uint32_t columns = 0;
  uint32_t rows = 0;
  std::vector<int64_t> errors;
};

// The cheapest palette of one tile with blocks of one size, built one symbol at a time.
class PaletteDecision {
 public:
  PaletteDecision(const BlockErrors& blocks, const std::vector<PaletteEntry>& symbols,
                  const PaletteFields& fields, Lambda lambda)
      : blocks_(blocks),
        symbols_(symbols),
        entry_bits_(palette_entry_bits(fields)),
        lambda_(lambda),
        count_(size_t{blocks.columns} * blocks.rows),
        least_(count_, std::numeric_limits<int64_t>::max() / (1 << 20)) {}

  void run() {
    // One more symbol may pay only together with the next one, as level counts grow in steps: the
    // search goes on while symbols reduce the error.
    while (palette_.size() < std::min(kMaxPaletteEntries, symbols_.size())) {
      if (!add_best()) break;
      const int64_t cost = cost_now();
      if (cost < best_cost_) {
        best_cost_ = cost;
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
        if (error(b, palette_[i]) < error(b, palette_[best])) best = i;
      }
      tile.indices.push_back(static_cast<uint8_t>(best));
    }
    return tile;
  }

 private:
  int64_t error(size_t block, size_t symbol) const {
    return blocks_.errors[block * symbols_.size() + symbol];
  }

  bool add_best() {
    int64_t best_gain = 0;
    size_t best = symbols_.size();
    for (size_t s = 0; s < symbols_.size(); ++s) {
      int64_t gain = 0;
      for (size_t b = 0; b < count_; ++b) gain += std::max<int64_t>(0, least_[b] - error(b, s));
      if (gain <= best_gain) continue;
      best_gain = gain;
      best = s;
    }
    if (best == symbols_.size()) return false;
    palette_.push_back(best);
    for (size_t b = 0; b < count_; ++b) least_[b] = std::min(least_[b], error(b, best));
    return true;
  }

  int64_t cost_now() const {
    int64_t error = 0;
    for (const int64_t least : least_) error += least;
    const auto size = static_cast<uint32_t>(palette_.size());
    const auto bits = static_cast<int64_t>(kMotionHeadBits + size * entry_bits_ +
                                           bise_bits(levels_of_code(level_code_for(size)), count_));
    return lambda_.cost(error, bits + kTileOverheadBits);
  }

  const BlockErrors& blocks_;
  const std::vector<PaletteEntry>& symbols_;
  unsigned entry_bits_;
  Lambda lambda_;
  size_t count_;
  std::vector<int64_t> least_;
  std::vector<size_t> palette_;
  int64_t best_cost_ = std::numeric_limits<int64_t>::max();
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
    load(tx, ty);
    MotionTileCode best;
    best.block_log2 = header_.motion_tile_log2;
    int64_t least = 0;
    for (size_t c = 0; c < cells_.errors.size(); c += symbols_.size()) {
      least += lambda_.cost(cells_.errors[c], 0);
    }
    const unsigned grid_log2 = header_.disparity_grid_log2;
    const unsigned last = std::min<unsigned>(kMaxMotionLog2, header_.motion_tile_log2);
    for (unsigned log2 = std::max<unsigned>(grid_log2, header_.block_log2); log2 <= last; ++log2) {
      const BlockErrors blocks = merged(log2 - grid_log2);
      PaletteDecision palette(blocks, symbols_, fields_, lambda_);
      palette.run();
      if (palette.cost() >= least) continue;
      least = palette.cost();
      best = palette.tile(log2);
    }
    return best;
  }

 private:
  void load(uint32_t tx, uint32_t ty) {
    const uint32_t per_tile = 1u << (header_.motion_tile_log2 - header_.disparity_grid_log2);
    cells_.columns = std::min(per_tile, grid_.blocks_x - tx * per_tile);
    cells_.rows = std::min(per_tile, grid_.blocks_y - ty * per_tile);
    cells_.errors.resize(size_t{cells_.columns} * cells_.rows * symbols_.size());
    for (uint32_t j = 0; j < cells_.rows; ++j) {
      for (uint32_t i = 0; i < cells_.columns; ++i) {
        cell_errors_.run(tx * per_tile + i, ty * per_tile + j,
                         &cells_.errors[(size_t{j} * cells_.columns + i) * symbols_.size()]);
      }
    }
  }

  // Errors of blocks of 2^shift cells a side.
  BlockErrors merged(unsigned shift) const {
    BlockErrors blocks;
    blocks.columns = ceil_div(cells_.columns, 1u << shift);
    blocks.rows = ceil_div(cells_.rows, 1u << shift);
    blocks.errors.resize(size_t{blocks.columns} * blocks.rows * symbols_.size());
    for (uint32_t j = 0; j < cells_.rows; ++j) {
      for (uint32_t i = 0; i < cells_.columns; ++i) {
        const size_t from = (size_t{j} * cells_.columns + i) * symbols_.size();
        const size_t to = (size_t{j >> shift} * blocks.columns + (i >> shift)) * symbols_.size();
        for (size_t s = 0; s < symbols_.size(); ++s) {
          blocks.errors[to + s] += cells_.errors[from + s];
        }
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
