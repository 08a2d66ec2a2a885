#include "encoder/disparity_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/error_kernels.hpp"
#include "encoder/motion_prediction.hpp"

namespace hmlfc {
namespace {

// At each end of the range, at most one block in this many has its match outside.
constexpr int64_t kRareBlocks = 400;
// A coarse search looks at all rows of blocks, if there are fewer than these.
constexpr uint32_t kFewRows = 12;
// A tile's disparities are looked for where a coarse look at some targets finds some.
constexpr int32_t kCoarseStep = 3;
constexpr int32_t kCoarseMargin = 2;
constexpr size_t kCoarseTargets = 3;
// So many targets make up for what each of them does not see.
constexpr size_t kManyTargets = 12;

// Holds what disparities leave to the residual, [d - lo][column], of grid blocks next to each
// other.
class RowCosts {
 public:
  // Blocks [bx0, bx1) of a row; candidates are `step` apart.
  RowCosts(const DisparitySearch& search, const DisparityRange& range, int32_t step, uint32_t bx0,
           uint32_t bx1)
      : search_(search),
        header_(search.header),
        rules_(vector_rules(header_)),
        bound_(reference_bound(Plane::kY, header_.depth, search.keyed)),
        grid_log2_(header_.disparity_grid_log2),
        range_(range),
        step_(step),
        estimate_(search.lambda),
        squares_apart_(grid_log2_ > 2 && search.targets.size() >= kManyTargets ? 2 : 1),
        x_(bx0 << grid_log2_),
        width_(std::min(bx1 << grid_log2_, header_.width) - x_),
        blocks_x_(bx1 - bx0),
        predicted_(size_t{width_} * kSquare),
        squares_(ceil_div(width_, kSquare)) {}

  size_t candidates() const { return static_cast<size_t>((range_.hi - range_.lo) / step_) + 1; }
  int64_t at(size_t candidate, uint32_t bx) const { return costs_[candidate * blocks_x_ + bx]; }

  // A target sees one of so many rows of squares.
  int64_t squares_apart() const { return squares_apart_; }

  // The first of the cheapest candidates.
  size_t cheapest(uint32_t bx) const {
    size_t best = 0;
    for (size_t k = 1; k < candidates(); ++k) {
      if (at(k, bx) < at(best, bx)) best = k;
    }
    return best;
  }

  // Row `by`, with every `apart`-th target. Of two rows of squares the even targets see the first,
  // the odd ones the second, unless there are few targets.
  void run(uint32_t by, size_t apart) {
    costs_.assign(candidates() * blocks_x_, 0);
    const uint32_t y0 = by << grid_log2_;
    const uint32_t y1 = std::min(y0 + (1u << grid_log2_), header_.height);
    for (size_t k = 0; k < candidates(); ++k) {
      const int32_t d = range_.lo + static_cast<int32_t>(k) * step_;
      for (size_t i = apart / 2; i < search_.targets.size(); i += apart) {
        const SearchTarget& target = search_.targets[i];
        const uint32_t first = static_cast<uint32_t>(i / apart % squares_apart_) * kSquare;
        for (uint32_t y = y0 + first; y < y1; y += squares_apart_ * kSquare) {
          add_squares(target, d, y, std::min(y + kSquare, y1), &costs_[k * blocks_x_]);
        }
      }
    }
  }

 private:
  static constexpr uint32_t kSquare = 4;

  // Adds the costs of `target` in rows [y, y1), at most four.
  void add_squares(const SearchTarget& target, int32_t d, uint32_t y, uint32_t y1, int64_t* costs) {
    std::array<DisplacedReference, 2> references{moved(target.first, d, y)};
    const bool two = target.second.plane != nullptr;
    if (two) references[1] = moved(target.second, d, y);
    interpolate_rect(references, two ? 2 : 1, bound_, {predicted_.data(), width_, width_, y1 - y});
    square_errors({target.plane->row(y).data() + x_, target.plane->width, width_, width_, y1 - y},
                  predicted_.data(), squares_.data());
    const uint32_t shift = grid_log2_ - 2;
    for (size_t i = 0; i < squares_.size(); ++i) costs[i >> shift] += estimate_(squares_[i]);
  }

  DisplacedReference moved(const SearchReference& reference, int32_t d, uint32_t y) const {
    const MotionVector v = disparity_vector(d, reference.row_offset, reference.col_offset, rules_);
    return displaced(*reference.plane, static_cast<int32_t>(x_), static_cast<int32_t>(y),
                     subpel_vector(v, header_.vector_precision, false));
  }

  const DisparitySearch& search_;
  const StreamHeader& header_;
  VectorRules rules_;
  int32_t bound_;
  unsigned grid_log2_;
  DisparityRange range_;
  int32_t step_;
  ResidualEstimate estimate_;
  uint32_t squares_apart_;
  uint32_t x_;
  uint32_t width_;
  uint32_t blocks_x_;
  std::vector<int16_t> predicted_;  // of at most four rows
  std::vector<uint32_t> squares_;   // of four columns each
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

// The grid blocks of one tile.
struct TileBlocks {
  uint32_t bx0, bx1, by0, by1;

  uint32_t columns() const { return bx1 - bx0; }
  size_t count() const { return size_t{columns()} * (by1 - by0); }
};

// The cheapest disparities of the blocks of `tile` among those in `range` that are `step` apart,
// with every `apart`-th target.
std::vector<int32_t> cheapest_disparities(const DisparitySearch& search,
                                          const DisparityRange& range, const TileBlocks& tile,
                                          int32_t step, size_t apart) {
  RowCosts costs(search, range, step, tile.bx0, tile.bx1);
  TileDisparities disparities(costs.candidates(), tile.count());
  const int64_t all = static_cast<int64_t>(search.images) * costs.squares_apart();
  const auto seen = std::max<int64_t>(1, static_cast<int64_t>(search.targets.size() / apart));
  for (uint32_t by = tile.by0; by < tile.by1; ++by) {
    costs.run(by, apart);
    const size_t row = size_t{by - tile.by0} * tile.columns();
    for (uint32_t bx = 0; bx < tile.columns(); ++bx) {
      for (size_t k = 0; k < costs.candidates(); ++k) {
        disparities.at(k, row + bx) = costs.at(k, bx) * all / seen;
      }
    }
  }
  std::vector<int32_t> cheapest;
  for (const uint16_t k : disparities.choose(search.lambda)) {
    cheapest.push_back(range.lo + k * step);
  }
  return cheapest;
}

void search_tile(const DisparitySearch& search, const DisparityRange& range, const TileBlocks& tile,
                 DisparityGrid& grid) {
  const size_t apart = std::max<size_t>(1, ceil_div(search.targets.size(), kCoarseTargets));
  const auto coarse = cheapest_disparities(search, range, tile, kCoarseStep, apart);
  const auto [least, most] = std::minmax_element(coarse.begin(), coarse.end());
  const DisparityRange likely{std::max(range.lo, *least - kCoarseMargin),
                              std::min(range.hi, *most + kCoarseMargin)};
  const auto chosen = cheapest_disparities(search, likely, tile, 1, 1);
  for (size_t b = 0; b < chosen.size(); ++b) {
    const size_t at =
        (tile.by0 + b / tile.columns()) * grid.blocks_x + tile.bx0 + b % tile.columns();
    grid.values[at] = static_cast<int16_t>(chosen[b]);
  }
}

}  // namespace

CoarseResult coarse_disparities(const DisparitySearch& search, int32_t limit) {
  const StreamHeader& header = search.header;
  const int32_t step = std::max(1, (1 << header.disparity_precision) / 4);
  const DisparityRange all{-limit, limit};
  const uint32_t blocks_x = ceil_div(header.width, 1u << header.disparity_grid_log2);
  const size_t candidates = RowCosts(search, all, step, 0, blocks_x).candidates();
  const uint32_t blocks_y = ceil_div(header.height, 1u << header.disparity_grid_log2);
  const uint32_t apart =
      blocks_y < kFewRows ? 1 : std::min(search.rows_apart, 2 * blocks_y / kFewRows);
  const uint32_t looked_at = blocks_y / apart;
  std::vector<std::vector<int64_t>> counts(looked_at, std::vector<int64_t>(candidates));
  std::vector<int64_t> errors(looked_at);
  parallel_for(looked_at, [&](size_t by) {
    RowCosts costs(search, all, step, 0, blocks_x);
    costs.run(static_cast<uint32_t>(by) * apart + apart / 2, 1);
    for (uint32_t bx = 0; bx < blocks_x; ++bx) {
      const size_t best = costs.cheapest(bx);
      ++counts[by][best];
      errors[by] += costs.at(best, bx);
    }
  });
  std::vector<int64_t> total(candidates);
  CoarseResult result;
  for (uint32_t by = 0; by < looked_at; ++by) {
    for (size_t k = 0; k < candidates; ++k) total[k] += counts[by][k];
    result.error += errors[by];
  }
  const int64_t rare = int64_t{blocks_x} * looked_at / kRareBlocks;
  size_t lo = 0;
  size_t hi = candidates - 1;
  for (int64_t sum = total[lo]; sum <= rare && lo < hi; sum += total[lo]) ++lo;
  for (int64_t sum = total[hi]; sum <= rare && hi > lo; sum += total[hi]) --hi;
  // Small blocks and other groups go beyond what is found here.
  const auto first = static_cast<int32_t>(lo);
  const auto last = static_cast<int32_t>(hi);
  const int32_t margin = 1 + (last - first + 2) / 3;
  result.range = {-limit + (first - margin) * step, -limit + (last + margin) * step};
  return result;
}

DisparityGrid search_disparities(const DisparitySearch& search, const DisparityRange& range) {
  const StreamHeader& header = search.header;
  DisparityGrid grid;
  grid.blocks_x = ceil_div(header.width, 1u << header.disparity_grid_log2);
  grid.blocks_y = ceil_div(header.height, 1u << header.disparity_grid_log2);
  grid.values.resize(size_t{grid.blocks_x} * grid.blocks_y);
  const uint32_t per_tile = 1u << (header.motion_tile_log2 - header.disparity_grid_log2);
  const uint32_t tiles_x = ceil_div(grid.blocks_x, per_tile);
  parallel_for(size_t{tiles_x} * ceil_div(grid.blocks_y, per_tile), [&](size_t i) {
    const auto tx = static_cast<uint32_t>(i % tiles_x);
    const auto ty = static_cast<uint32_t>(i / tiles_x);
    const TileBlocks tile{tx * per_tile, std::min((tx + 1) * per_tile, grid.blocks_x),
                          ty * per_tile, std::min((ty + 1) * per_tile, grid.blocks_y)};
    search_tile(search, range, tile, grid);
  });
  return grid;
}

}  // namespace hmlfc
