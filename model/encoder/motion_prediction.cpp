#include "encoder/motion_prediction.hpp"

#include <algorithm>

#include "arithmetic/motion.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc {
namespace {

// The reference sets worth trying: those without an image that also has a lower number.
std::vector<uint8_t> reference_sets(const MotionSources& sources) {
  if (!sources.two_references()) return {0};
  const auto repeated = [&](size_t k) {
    const auto end = sources.places.begin() + static_cast<ptrdiff_t>(k);
    return std::find(sources.places.begin(), end, sources.places[k]) != end;
  };
  std::vector<uint8_t> sets;
  for (uint8_t set = 0; set < kReferenceSets; ++set) {
    const ReferenceSet refs = references_of_set(set);
    if (repeated(refs.reference[0]) || (refs.count == 2 && repeated(refs.reference[1]))) continue;
    sets.push_back(set);
  }
  return sets;
}

class PlanePredictor {
 public:
  PlanePredictor(const MotionSources& sources, Plane plane, const SamplePlane* parent,
                 const ReferencePlanes& references, std::span<const MotionTileCode> tiles)
      : sources_(sources),
        parent_(parent),
        references_(references),
        tiles_(tiles),
        default_symbol_(sources.default_symbol()),
        shape_(sources.geometry.plane(plane)),
        motion_(sources.geometry.motion_planes()[sources.geometry.motion_plane_of(plane)]),
        halved_(plane != Plane::kY && motion_.halves),
        size_(static_cast<int32_t>(sources.geometry.block_size())),
        range_(sample_range(plane, sources.header.depth)),
        bound_(reference_bound(plane, sources.header.depth, sources.keyed)) {}

  SamplePlane run() const {
    const auto size = static_cast<uint32_t>(size_);
    SamplePlane plane(shape_.blocks_x * size, shape_.blocks_y * size);
    for (uint32_t by = 0; by < shape_.blocks_y; ++by) {
      for (uint32_t bx = 0; bx < shape_.blocks_x;) bx = predict(bx, by, plane);
    }
    return plane;
  }

 private:
  // The palette entry of the block at place (x, y) of the motion plane (MOT-4).
  const PaletteEntry& symbol_at(uint32_t x, uint32_t y) const {
    const unsigned tile_log2 = sources_.header.motion_tile_log2;
    const uint32_t tx = x >> tile_log2;
    const uint32_t ty = y >> tile_log2;
    const MotionTileCode& tile = tiles_[size_t{ty} * motion_.tiles_x + tx];
    if (tile.empty) return default_symbol_;
    const uint32_t mask = (1u << tile_log2) - 1;
    const uint32_t inside = std::min(mask + 1, motion_.width - (tx << tile_log2));
    const uint32_t columns = ceil_div(inside, 1u << tile.block_log2);
    const uint32_t index =
        ((y & mask) >> tile.block_log2) * columns + ((x & mask) >> tile.block_log2);
    return tile.palette[tile.indices[index]];
  }

  // What one block, or several with the same, is predicted with.
  struct Motion {
    PaletteEntry symbol;
    int32_t disparity = 0;
    friend bool operator==(const Motion&, const Motion&) = default;
  };

  Motion motion_at(uint32_t bx, uint32_t by) const {
    const auto scale = static_cast<uint32_t>(halved_ ? 2 * size_ : size_);
    const uint32_t x = bx * scale;
    const uint32_t y = by * scale;
    const PaletteEntry& symbol = symbol_at(x, y);
    if (!symbol.shares_disparity()) return {symbol};
    const unsigned grid_log2 = sources_.header.disparity_grid_log2;
    return {symbol, sources_.disparity(x >> grid_log2, y >> grid_log2, symbol.choice)};
  }

  // Predicts the blocks from (bx, by) to the right that have one motion; returns where they end.
  uint32_t predict(uint32_t bx, uint32_t by, SamplePlane& plane) const {
    const Motion motion = motion_at(bx, by);
    uint32_t end = bx + 1;
    while (end < shape_.blocks_x && motion_at(end, by) == motion) ++end;
    const Area area{static_cast<int32_t>(bx) * size_, static_cast<int32_t>(by) * size_,
                    static_cast<int32_t>(end - bx) * size_, size_};
    const auto x = static_cast<uint32_t>(area.x);
    const bool moves = motion.symbol.choice != kChoiceNone;
    if (moves)
      read_references(motion, area, plane.row(static_cast<uint32_t>(area.y)).data() + x,
                      plane.width);
    if (sources_.keyed && moves) return end;
    for (int32_t y = area.y; y < area.y + size_; ++y) {
      const auto out =
          plane.row(static_cast<uint32_t>(y)).subspan(x, static_cast<size_t>(area.width));
      for (size_t i = 0; i < out.size(); ++i) {
        const int32_t base = parent_ == nullptr ? 0
                                                : parent_->at(x + static_cast<uint32_t>(i),
                                                              static_cast<uint32_t>(y));
        out[i] = static_cast<int16_t>(
            moves ? motion_prediction(base, motion.symbol.negative, out[i], range_) : base);
      }
    }
    return end;
  }

  void read_references(const Motion& motion, const Area& area, int16_t* out, size_t stride) const {
    const ReferenceSet refs = references_of_set(motion.symbol.reference_set);
    std::array<DisplacedReference, 2> parts;
    for (size_t i = 0; i < refs.count; ++i) {
      const size_t k = refs.reference[i];
      parts[i] = displaced(*references_[k], area.x, area.y,
                           sources_.vector(k, motion.symbol, motion.disparity, halved_));
    }
    interpolate_rect(
        parts, refs.count, bound_,
        {out, stride, static_cast<unsigned>(area.width), static_cast<unsigned>(area.height)});
  }

  const MotionSources& sources_;
  const SamplePlane* parent_;
  const ReferencePlanes& references_;
  std::span<const MotionTileCode> tiles_;
  PaletteEntry default_symbol_;
  const PlaneShape& shape_;
  const MotionPlaneShape& motion_;
  bool halved_;
  int32_t size_;
  SampleRange range_;
  int32_t bound_;
};

}  // namespace

std::vector<PaletteEntry> candidate_symbols(const MotionSources& sources, unsigned choices) {
  std::vector<PaletteEntry> symbols{sources.default_symbol()};
  for (unsigned choice = 1; choice <= choices; ++choice) {
    for (const uint8_t set : reference_sets(sources)) {
      const PaletteEntry plus{set, static_cast<uint8_t>(choice)};
      if (plus != symbols.front()) symbols.push_back(plus);
      if (sources.keyed) continue;
      PaletteEntry minus = plus;
      minus.negative = true;
      symbols.push_back(minus);
    }
  }
  return symbols;
}

SamplePlane predict_plane(const MotionSources& sources, Plane plane, const SamplePlane* parent,
                          const ReferencePlanes& references,
                          std::span<const MotionTileCode> tiles) {
  return PlanePredictor(sources, plane, parent, references, tiles).run();
}

}  // namespace hmlfc
