#include "encoder/disparity_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/motion_prediction.hpp"

namespace hmlfc {
namespace {

// At each end of the range, at most one block in this many has its match outside.
constexpr int64_t kRareBlocks = 400;

// Squared errors [d - lo][column] of one row of grid blocks.
class RowCosts {
 public:
  RowCosts(const DisparitySearch& search, const DisparityRange& range, int32_t step)
      : search_(search),
        range_(range),
        step_(step),
        blocks_x_(ceil_div(search.width, 1u << search.grid_log2)),
        line_(size_t{search.width}),
        predicted_(size_t{search.width}) {}

  uint32_t blocks_x() const { return blocks_x_; }
  size_t candidates() const { return static_cast<size_t>((range_.hi - range_.lo) / step_) + 1; }
  int64_t at(size_t candidate, uint32_t bx) const { return costs_[candidate * blocks_x_ + bx]; }

  void run(uint32_t by) {
    costs_.assign(candidates() * blocks_x_, 0);
    const uint32_t y0 = by << search_.grid_log2;
    const uint32_t y1 = std::min(y0 + (1u << search_.grid_log2), search_.height);
    for (size_t k = 0; k < candidates(); ++k) {
      const int32_t d = range_.lo + static_cast<int32_t>(k) * step_;
      for (const SearchTarget& target : search_.targets) {
        const MotionVector v =
            disparity_vector(d, target.row_offset, target.col_offset, search_.rules);
        const SubpelVector vector = subpel_vector(v, search_.vector_precision, false);
        for (uint32_t y = y0; y < y1; ++y) add_line(target, vector, y, &costs_[k * blocks_x_]);
      }
    }
  }

 private:
  void add_line(const SearchTarget& target, const SubpelVector& vector, uint32_t y,
                int64_t* costs) {
    const Area area{0, static_cast<int32_t>(y), static_cast<int32_t>(search_.width), 1};
    interpolate(*search_.reference, area, vector, line_.data());
    combine(line_.data(), nullptr, area.width, predicted_.data());
    const int16_t* row = target.plane->row(y).data();
    const uint32_t size = 1u << search_.grid_log2;
    for (uint32_t bx = 0; bx < blocks_x_; ++bx) {
      const uint32_t end = std::min((bx + 1) * size, search_.width);
      int32_t sum = 0;
      for (uint32_t x = bx * size; x < end; ++x) {
        const int32_t error = row[x] - predicted_[x];
        sum += error * error;
      }
      costs[bx] += sum;
    }
  }

  const DisparitySearch& search_;
  DisparityRange range_;
  int32_t step_;
  uint32_t blocks_x_;
  std::vector<int32_t> line_;
  std::vector<int32_t> predicted_;
  std::vector<int64_t> costs_;
};

// The cheapest window of disparities for the blocks of one tile, whose costs are [d][block].
class TileDisparities {
 public:
  TileDisparities(size_t candidates, size_t blocks)
      : candidates_(candidates), blocks_(blocks), costs_(candidates * blocks) {}

  int64_t& at(size_t candidate, size_t block) { return costs_[candidate * blocks_ + block]; }

  // The chosen candidate of each block.
  std::vector<uint16_t> choose(Lambda lambda) const {
    int64_t best = std::numeric_limits<int64_t>::max();
    size_t best_lo = 0;
    size_t best_hi = 0;
    std::vector<int64_t> least(blocks_);
    for (size_t lo = 0; lo < candidates_; ++lo) {
      std::copy_n(costs_.begin() + static_cast<ptrdiff_t>(lo * blocks_), blocks_, least.begin());
      for (size_t hi = lo; hi < candidates_; ++hi) {
        int64_t error = 0;
        for (size_t b = 0; b < blocks_; ++b) {
          least[b] = std::min(least[b], costs_[hi * blocks_ + b]);
          error += least[b];
        }
        const Levels levels = levels_of_code(level_code_for(static_cast<uint32_t>(hi - lo) + 1));
        if (levels.count != hi - lo + 1 && hi + 1 != candidates_) continue;
        const int64_t cost = lambda.cost(error, static_cast<int64_t>(bise_bits(levels, blocks_)));
        if (cost >= best) continue;
        best = cost;
        best_lo = lo;
        best_hi = hi;
      }
    }
    return within(best_lo, best_hi);
  }

 private:
  std::vector<uint16_t> within(size_t lo, size_t hi) const {
    std::vector<uint16_t> chosen(blocks_, static_cast<uint16_t>(lo));
    for (size_t b = 0; b < blocks_; ++b) {
      for (size_t d = lo + 1; d <= hi; ++d) {
        if (costs_[d * blocks_ + b] < costs_[chosen[b] * blocks_ + b]) {
          chosen[b] = static_cast<uint16_t>(d);
        }
      }
    }
    return chosen;
  }

  size_t candidates_;
  size_t blocks_;
  std::vector<int64_t> costs_;
};

// The disparities of one row of tiles.
void search_tile_row(const DisparitySearch& search, const DisparityRange& range, uint32_t ty,
                     DisparityGrid& grid) {
  const uint32_t per_tile = 1u << (search.tile_log2 - search.grid_log2);
  const uint32_t by0 = ty * per_tile;
  const uint32_t rows = std::min(per_tile, grid.blocks_y - by0);
  const uint32_t tiles_x = ceil_div(grid.blocks_x, per_tile);
  RowCosts costs(search, range, 1);
  std::vector<TileDisparities> tiles;
  for (uint32_t tx = 0; tx < tiles_x; ++tx) {
    const uint32_t columns = std::min(per_tile, grid.blocks_x - tx * per_tile);
    tiles.emplace_back(costs.candidates(), size_t{columns} * rows);
  }
  for (uint32_t j = 0; j < rows; ++j) {
    costs.run(by0 + j);
    for (uint32_t bx = 0; bx < grid.blocks_x; ++bx) {
      const uint32_t tx = bx / per_tile;
      const uint32_t columns = std::min(per_tile, grid.blocks_x - tx * per_tile);
      for (size_t k = 0; k < costs.candidates(); ++k) {
        tiles[tx].at(k, size_t{j} * columns + bx % per_tile) = costs.at(k, bx);
      }
    }
  }
  for (uint32_t tx = 0; tx < tiles_x; ++tx) {
    const uint32_t columns = std::min(per_tile, grid.blocks_x - tx * per_tile);
    const auto chosen = tiles[tx].choose(search.lambda);
    for (size_t b = 0; b < chosen.size(); ++b) {
      const size_t at = (by0 + b / columns) * grid.blocks_x + tx * per_tile + b % columns;
      grid.values[at] = static_cast<int16_t>(range.lo + chosen[b]);
    }
  }
}

}  // namespace

CoarseResult coarse_disparities(const DisparitySearch& search, int32_t limit) {
  const int32_t step = std::max(1, (1 << search.disparity_precision) / 4);
  const DisparityRange all{-limit, limit};
  RowCosts probe(search, all, step);
  const size_t candidates = probe.candidates();
  const uint32_t blocks_y = ceil_div(search.height, 1u << search.grid_log2);
  std::vector<std::vector<int64_t>> counts(blocks_y, std::vector<int64_t>(candidates));
  std::vector<int64_t> errors(blocks_y);
  parallel_for(blocks_y, [&](size_t by) {
    RowCosts costs(search, all, step);
    costs.run(static_cast<uint32_t>(by));
    for (uint32_t bx = 0; bx < costs.blocks_x(); ++bx) {
      size_t best = 0;
      for (size_t k = 1; k < candidates; ++k) {
        if (costs.at(k, bx) < costs.at(best, bx)) best = k;
      }
      ++counts[by][best];
      errors[by] += costs.at(best, bx);
    }
  });
  std::vector<int64_t> total(candidates);
  CoarseResult result;
  for (uint32_t by = 0; by < blocks_y; ++by) {
    for (size_t k = 0; k < candidates; ++k) total[k] += counts[by][k];
    result.error += errors[by];
  }
  const int64_t rare = int64_t{probe.blocks_x()} * blocks_y / kRareBlocks;
  size_t lo = 0;
  size_t hi = candidates - 1;
  for (int64_t sum = total[lo]; sum <= rare && lo < hi; sum += total[lo]) ++lo;
  for (int64_t sum = total[hi]; sum <= rare && hi > lo; sum += total[hi]) --hi;
  result.range = {-limit + (static_cast<int32_t>(lo) - 1) * step,
                  -limit + (static_cast<int32_t>(hi) + 1) * step};
  return result;
}

DisparitySearch disparity_search(const StreamHeader& header) {
  DisparitySearch search;
  search.width = header.width;
  search.height = header.height;
  search.rules = vector_rules(header);
  search.vector_precision = header.vector_precision;
  search.disparity_precision = header.disparity_precision;
  search.grid_log2 = header.disparity_grid_log2;
  search.tile_log2 = header.motion_tile_log2;
  return search;
}

DisparityGrid search_disparities(const DisparitySearch& search, const DisparityRange& range) {
  DisparityGrid grid;
  grid.blocks_x = ceil_div(search.width, 1u << search.grid_log2);
  grid.blocks_y = ceil_div(search.height, 1u << search.grid_log2);
  grid.values.resize(size_t{grid.blocks_x} * grid.blocks_y);
  const uint32_t tiles_y = ceil_div(search.height, 1u << search.tile_log2);
  parallel_for(tiles_y,
               [&](size_t ty) { search_tile_row(search, range, static_cast<uint32_t>(ty), grid); });
  return grid;
}

}  // namespace hmlfc
