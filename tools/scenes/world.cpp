#include "scenes/world.hpp"

#include <algorithm>

namespace hmlfc::scenes {
namespace {

constexpr uint32_t kTile = 16;

uint32_t tile_count(uint32_t pixels) { return (pixels + kTile - 1) / kTile; }

/// The tile of a picture coordinate, clamped to the existing ones.
uint32_t clamped_tile(double coordinate, uint32_t tiles) {
  const double tile = coordinate / kTile;
  if (tile <= 0) return 0;
  return tile >= tiles ? tiles - 1 : static_cast<uint32_t>(tile);
}

}  // namespace

TileBins::TileBins(const World& world, const ViewCamera& camera, uint32_t width, uint32_t height)
    : tiles_across_(tile_count(width)) {
  const uint32_t tiles_down = tile_count(height);
  struct Placed {
    Entry entry;
    TileRange range;
  };
  std::vector<Placed> visible;
  for (const Shape& shape : world) {
    const auto corners = shape.corners();
    // A margin of one pixel for the rounding of rays and boxes.
    const PixelBox box = camera.bounds(corners);
    if (box.right < -1 || box.bottom < -1 || box.left > width + 1.0 || box.top > height + 1.0) {
      continue;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : corners) nearest = std::min(nearest, camera.distance(corner));
    visible.push_back(
        {{&shape, nearest * (1.0 - 1e-9)},
         {clamped_tile(box.left - 1, tiles_across_), clamped_tile(box.top - 1, tiles_down),
          clamped_tile(box.right + 1, tiles_across_), clamped_tile(box.bottom + 1, tiles_down)}});
  }
  std::ranges::stable_sort(visible, {}, [](const Placed& p) { return p.entry.nearest; });

  const auto for_each_tile = [&](const TileRange& range, const auto& visit) {
    for (uint32_t y = range.top; y <= range.bottom; ++y) {
      for (uint32_t x = range.left; x <= range.right; ++x) visit(y * tiles_across_ + x);
    }
  };
  starts_.assign(size_t{tiles_across_} * tiles_down + 1, 0);
  for (const Placed& placed : visible) {
    for_each_tile(placed.range, [&](uint32_t tile) { ++starts_[tile + 1]; });
  }
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  entries_.resize(starts_.back());
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const Placed& placed : visible) {
    for_each_tile(placed.range, [&](uint32_t tile) { entries_[next[tile]++] = placed.entry; });
  }
}

std::span<const TileBins::Entry> TileBins::tile(uint32_t px, uint32_t py) const {
  const size_t index = size_t{py / kTile} * tiles_across_ + px / kTile;
  return std::span(entries_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
}

Hit TileBins::first_hit(const Ray& ray, uint32_t px, uint32_t py) const {
  Hit hit;
  for (const Entry& entry : tile(px, py)) {
    if (entry.nearest >= hit.t) break;
    const double t = entry.shape->enter(ray);
    if (t < hit.t) hit = {t, entry.shape};
  }
  return hit;
}

}  // namespace hmlfc::scenes
