#include "encoder/motion_decision.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/cell_errors.hpp"
#include "encoder/vector_search.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kMaxMotionLog2 = 5;
// About what the two fields of a vector take, at least.
constexpr unsigned kLeastVectorBits = 14;

// Errors [symbol][block] of the motion blocks of one size in one tile. Those of a tile under one
// symbol add up to less than 2^30: at the coarsest quality an estimate is at most 10^6.
struct BlockErrors {
  uint32_t columns = 0;
  uint32_t rows = 0;
  std::vector<int32_t> errors;

  size_t count() const { return size_t{columns} * rows; }

  // Of each block, under the symbol that leaves least.
  std::vector<int32_t> least() const {
    std::vector<int32_t> least(errors.begin(), errors.begin() + static_cast<ptrdiff_t>(count()));
    for (size_t first = count(); first < errors.size(); first += count()) {
      for (size_t b = 0; b < count(); ++b) least[b] = std::min(least[b], errors[first + b]);
    }
    return least;
  }
};

// The fields explicit_x and explicit_y of a palette (MOT-3).
struct ExplicitFields {
  unsigned bits = 0;  // of each
  unsigned count = 0;

  ExplicitFields with(const PaletteEntry& entry) const {
    if (entry.choice != kChoiceVector) return *this;
    return {std::max(bits, explicit_bits(entry)), count + 2};
  }
  int64_t all() const { return int64_t{bits} * count; }
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
    const std::vector<int32_t> floor = blocks_.least();
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
    int64_t best_gain = 0;
    size_t best = symbols_.size();
    for (size_t s = 0; s < symbols_.size(); ++s) {
      const int32_t* of_symbol = errors(s);
      int32_t saved = 0;
      for (size_t b = 0; b < count_; ++b) saved += std::max(0, least_[b] - of_symbol[b]);
      const int64_t more = explicit_.with(symbols_[s]).all() - explicit_.all();
      const int64_t gain = lambda_.cost(saved, -more);
      if (gain <= best_gain) continue;
      best_gain = gain;
      best = s;
    }
    if (best == symbols_.size()) return false;
    palette_.push_back(best);
    explicit_ = explicit_.with(symbols_[best]);
    const int32_t* of_symbol = errors(best);
    for (size_t b = 0; b < count_; ++b) least_[b] = std::min(least_[b], of_symbol[b]);
    return true;
  }

  int64_t cost(const std::vector<int32_t>& errors, size_t entries) const {
    const auto size = static_cast<uint32_t>(entries);
    const auto bits =
        static_cast<int64_t>(kMotionHeadBits + size * entry_bits_ +
                             bise_bits(levels_of_code(level_code_for(size)), count_)) +
        explicit_.all();
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
  ExplicitFields explicit_;
  int64_t best_cost_;
  size_t best_size_ = 0;
};

class TileDecision {
 public:
  TileDecision(const MotionTask& task, const std::vector<PaletteEntry>& symbols)
      : header_(task.sources.header),
        lambda_{task.lambda.scaled >> shift_of(task.lambda)},
        fields_{task.sources.two_references(), !task.sources.keyed},
        grid_(task.sources.grid),
        vectors_(task.sources.keyed ? task.vectors : 0),
        known_(symbols),
        cell_errors_(task, symbols),
        search_(task, symbols) {}

  MotionTileCode run(uint32_t tx, uint32_t ty) {
    MotionTileCode best;
    best.block_log2 = header_.motion_tile_log2;
    int64_t sum = 0;
    for_each_row(tx, ty, [&](uint32_t) { sum += cell_errors_.of_first_symbol(); });
    int64_t least = lambda_.cost(sum, 0);
    // Whatever the motion, a record costs as much.
    if (least <= lambda_.cost(0, kMotionHeadBits + palette_entry_bits(fields_) + kTileOverheadBits))
      return best;
    symbols_ = known_;
    cells_.errors.resize(cells_.count() * symbols_.size());
    for_each_row(tx, ty, [&](uint32_t row) {
      cell_errors_.run(&cells_.errors[size_t{row} * cells_.columns], cells_.count());
    });
    add_vectors(tx, ty);
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

  // Makes symbols of the vectors that are found for the blocks that are predicted worst.
  void add_vectors(uint32_t tx, uint32_t ty) {
    if (vectors_ == 0) return;
    const int64_t entry = lambda_.cost(0, palette_entry_bits(fields_) + kLeastVectorBits);
    constexpr uint32_t kSide = VectorSearch::kSide;
    const BlockErrors blocks =
        merged(static_cast<unsigned>(std::bit_width(kSide)) - 1 - header_.disparity_grid_log2);
    const std::vector<int32_t> of_blocks = blocks.least();
    std::vector<size_t> worst(of_blocks.size());
    std::iota(worst.begin(), worst.end(), size_t{0});
    std::ranges::stable_sort(worst, std::greater(), [&](size_t b) { return of_blocks[b]; });
    worst.resize(std::min(worst.size(), vectors_));
    std::vector<int32_t> least = cells_.least();
    for (const size_t b : worst) {
      if (lambda_.cost(of_blocks[b], 0) <= entry) break;
      Area area{static_cast<int32_t>((tx << header_.motion_tile_log2) + b % blocks.columns * kSide),
                static_cast<int32_t>((ty << header_.motion_tile_log2) + b / blocks.columns * kSide),
                kSide, kSide};
      area.width = std::min(area.width, static_cast<int32_t>(header_.width) - area.x);
      area.height = std::min(area.height, static_cast<int32_t>(header_.height) - area.y);
      for (const PaletteEntry& symbol : search_.run(area, of_blocks[b])) {
        if (std::ranges::find(symbols_, symbol) == symbols_.end())
          add_symbol(tx, ty, symbol, least, entry);
      }
    }
  }

  // Adds `symbol` if it is worth an entry in the tile, whose cells have `least` without it.
  void add_symbol(uint32_t tx, uint32_t ty, const PaletteEntry& symbol, std::vector<int32_t>& least,
                  int64_t entry) {
    std::vector<int32_t> errors(cells_.count());
    for_each_row(tx, ty, [&](uint32_t row) {
      cell_errors_.of_vector(symbol, &errors[size_t{row} * cells_.columns]);
    });
    int64_t saved = 0;
    for (size_t c = 0; c < errors.size(); ++c) saved += std::max(0, least[c] - errors[c]);
    if (lambda_.cost(saved, 0) <= entry) return;
    symbols_.push_back(symbol);
    cells_.errors.insert(cells_.errors.end(), errors.begin(), errors.end());
    std::ranges::transform(least, errors, least.begin(),
                           [](int32_t a, int32_t b) { return std::min(a, b); });
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
  size_t vectors_;
  const std::vector<PaletteEntry>& known_;  // symbols to try in every tile
  std::vector<PaletteEntry> symbols_;       // and vectors of the tile
  CellErrors cell_errors_;
  VectorSearch search_;
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
