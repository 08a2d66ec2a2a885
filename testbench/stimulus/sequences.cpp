#include "stimulus/sequences.hpp"

#include <algorithm>
#include <numeric>

#include "arithmetic/rounding.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kTilesInSquare = 2;  // on a side
constexpr uint32_t kSquaresInMacroRow = 2;
constexpr uint64_t kBlocksOfTile = 64;
constexpr uint64_t kBlocksOfSquare = kBlocksOfTile * kTilesInSquare * kTilesInSquare;
constexpr uint32_t kSquareSide = kTilesInSquare * kTileBlocks;

Plane plane_of(unsigned plane) { return plane == kRgb ? Plane::kY : static_cast<Plane>(plane); }

// The requests of one scan plan.
class Scan {
 public:
  Scan(const Geometry& geometry, const StreamHeader& header, const ScanPlan& plan)
      : plan_(plan),
        header_(header),
        shape_(geometry.plane(plane_of(plan.plane))),
        random_(plan.seed),
        order_(shape_.blocks_x, shape_.blocks_y) {
    const uint64_t grid = uint64_t{header.rows} * header.cols;
    views_.resize(static_cast<size_t>(grid));
    std::iota(views_.begin(), views_.end(), 0u);
    const auto count = static_cast<size_t>(std::min(plan.views, grid));
    for (size_t i = 0; i < count; ++i) {
      std::swap(views_[i], views_[i + random_.below(grid - i)]);
    }
    views_.resize(count);
  }

  std::optional<Request> next() {
    while (view_ < views_.size()) {
      const auto block = order_.next();
      if (!block) {
        order_ = ScanOrder(shape_.blocks_x, shape_.blocks_y);
        ++view_;
        continue;
      }
      if (plan_.fraction < 1 && random_.below(1u << 30) >= plan_.fraction * (1u << 30)) continue;
      return plan_.random_order ? any() : request(view_, block->bx, block->by);
    }
    return std::nullopt;
  }

 private:
  Request request(size_t view, uint32_t bx, uint32_t by) const {
    return {views_[view] / header_.cols,
            views_[view] % header_.cols,
            bx,
            by,
            plan_.plane,
            plan_.stop_level,
            bx + 1 == shape_.blocks_x && by + 1 == shape_.blocks_y};
  }

  Request any() {
    return request(random_.below(views_.size()), random_.below(shape_.blocks_x),
                   random_.below(shape_.blocks_y));
  }

  ScanPlan plan_;
  StreamHeader header_;
  PlaneShape shape_;
  Random random_;
  ScanOrder order_;
  std::vector<uint32_t> views_;
  size_t view_ = 0;
};

// A random walk over everything that can be asked.
class Mixer {
 public:
  Mixer(const Geometry& geometry, const StreamHeader& header, uint64_t count, uint64_t seed,
        unsigned bad)
      : geometry_(geometry),
        header_(header),
        refused_(bad_requests(geometry, header)),
        random_(seed),
        left_(count),
        bad_(bad) {
    jump();
  }

  std::optional<Request> next() {
    if (left_ == 0) return std::nullopt;
    --left_;
    const bool last = random_.chance(100);
    if (random_.chance(bad_)) {
      Request refused = refused_[random_.below(refused_.size())];
      refused.last = last;
      return refused;
    }
    step();
    at_.last = last;
    return at_;
  }

 private:
  void step() {
    const unsigned kind = random_.below(10);
    if (kind == 0) jump();
    if (kind == 1) at_.plane = random_.below(4);
    if (kind == 2) at_.stop_level = random_.below(static_cast<uint64_t>(header_.tree_height) + 1);
    if (kind == 3) at_.row = random_.below(header_.rows);
    if (kind == 4) at_.col = random_.below(header_.cols);
    if (kind == 5) at_.stop_level = 0;
    if (kind == 6) ++at_.by;
    if (kind >= 7 && kind < 9) ++at_.bx;
    const PlaneShape& shape = geometry_.plane(plane_of(at_.plane));
    at_.bx %= shape.blocks_x;
    at_.by %= shape.blocks_y;
  }

  void jump() {
    at_.plane = random_.chance(500) ? kRgb : random_.below(3);
    const PlaneShape& shape = geometry_.plane(plane_of(at_.plane));
    at_.row = random_.below(header_.rows);
    at_.col = random_.below(header_.cols);
    at_.bx = random_.below(shape.blocks_x);
    at_.by = random_.below(shape.blocks_y);
  }

  const Geometry& geometry_;
  const StreamHeader& header_;
  std::vector<Request> refused_;
  Random random_;
  uint64_t left_;
  unsigned bad_;
  Request at_;
};

// A source that owns `maker`.
template <class Maker>
RequestSource source_of(std::shared_ptr<Maker> maker) {
  return [maker] { return maker->next(); };
}

}  // namespace

std::optional<ScanOrder::Block> ScanOrder::next() {
  const uint32_t squares_x = ceil_div(columns_, kSquareSide);
  const uint64_t macro_row = uint64_t{squares_x} * kSquaresInMacroRow * kBlocksOfSquare;
  while (true) {
    const uint64_t at = at_++;
    const auto macro = static_cast<uint32_t>(at / macro_row);
    const auto square = static_cast<uint32_t>(at % macro_row / kBlocksOfSquare);
    const auto tile = static_cast<uint32_t>(at % kBlocksOfSquare / kBlocksOfTile);
    const auto k = static_cast<unsigned>(at % kBlocksOfTile);
    const uint32_t y0 = (macro * kSquaresInMacroRow + square % kSquaresInMacroRow) * kSquareSide;
    if (macro * kSquaresInMacroRow * kSquareSide >= rows_) return std::nullopt;
    const uint32_t bx = square / kSquaresInMacroRow * kSquareSide +
                        tile % kTilesInSquare * kTileBlocks + block_column(k);
    const uint32_t by = y0 + tile / kTilesInSquare * kTileBlocks + block_row(k);
    if (bx < columns_ && by < rows_) return Block{bx, by};
  }
}

RequestSource scan_requests(const Geometry& geometry, const StreamHeader& header,
                            const ScanPlan& plan) {
  return source_of(std::make_shared<Scan>(geometry, header, plan));
}

RequestSource mixed_requests(const Geometry& geometry, const StreamHeader& header, uint64_t count,
                             uint64_t seed, unsigned bad) {
  return source_of(std::make_shared<Mixer>(geometry, header, count, seed, bad));
}

RequestSource with_residuals(RequestSource source, uint64_t seed, unsigned permille) {
  return [source = std::move(source), random = Random(seed), permille]() mutable {
    std::optional<Request> request = source();
    if (request && random.chance(permille)) {
      request->residuals = true;
      if (request->plane == kRgb && random.chance(900)) request->plane = 0;
    }
    return request;
  };
}

RequestSource listed_requests(std::vector<Request> requests) {
  auto list = std::make_shared<std::vector<Request>>(std::move(requests));
  return [list, at = size_t{0}]() mutable -> std::optional<Request> {
    if (at == list->size()) return std::nullopt;
    return (*list)[at++];
  };
}

std::vector<Request> border_requests(const Geometry& geometry, const StreamHeader& header) {
  std::vector<Request> requests;
  const std::array<std::array<uint32_t, 2>, 3> views{
      {{0, 0}, {header.rows / 2, header.cols / 2}, {header.rows - 1, header.cols - 1}}};
  for (const auto& view : views) {
    for (unsigned plane = 0; plane <= kRgb; ++plane) {
      const PlaneShape& shape = geometry.plane(plane_of(plane));
      for (int stop = 0; stop <= header.tree_height; ++stop) {
        for (const uint32_t by : {0u, shape.blocks_y / 2, shape.blocks_y - 1}) {
          for (const uint32_t bx : {0u, shape.blocks_x / 2, shape.blocks_x - 1}) {
            requests.push_back(
                {view[0], view[1], bx, by, plane, static_cast<unsigned>(stop), bx == 0});
          }
        }
      }
    }
  }
  return requests;
}

std::vector<Request> bad_requests(const Geometry& geometry, const StreamHeader& header) {
  const PlaneShape& luma = geometry.plane(Plane::kY);
  const PlaneShape& chroma = geometry.plane(Plane::kCo);
  std::vector<Request> requests{
      {header.rows, 0, 0, 0, 0, 0, false},      {0, header.cols, 0, 0, 0, 0, false},
      {4095, 4095, 0, 0, kRgb, 0, true},        {0, 0, luma.blocks_x, 0, 0, 0, false},
      {0, 0, 0, luma.blocks_y, kRgb, 0, false}, {0, 0, chroma.blocks_x, 0, 1, 0, false},
      {0, 0, 0, chroma.blocks_y, 2, 0, true},   {0, 0, 32767, 32767, kRgb, 0, false}};
  if (header.tree_height < 15) {
    requests.push_back({0, 0, 0, 0, 0, static_cast<unsigned>(header.tree_height) + 1, false});
    requests.push_back({0, 0, 0, 0, kRgb, 15, false});
  }
  return requests;
}

Conditions random_conditions(uint64_t seed) {
  Random random(seed);
  const auto maybe = [&](uint32_t most) { return random.chance(500) ? random.within(1, most) : 0; };
  Conditions conditions;
  conditions.latency = random.chance(250) ? 0 : random.within(0, 200);
  conditions.latency_jitter = maybe(50);
  conditions.stall = maybe(700);
  conditions.address_stall = maybe(700);
  conditions.backpressure = maybe(800);
  conditions.request_gap = maybe(800);
  return conditions;
}

}  // namespace hmlfc::tb
