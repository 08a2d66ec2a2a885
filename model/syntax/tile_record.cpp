#include "syntax/tile_record.hpp"

#include <algorithm>

#include "syntax/index.hpp"
#include "syntax/tile_layout.hpp"

namespace hmlfc {
namespace {

// The record of tile number `tile` (IDX-2).
Result<std::optional<TileRecord>> load_record(const StreamView& stream, uint64_t tile,
                                              const Probe& probe) {
  const auto extent = find_tile(stream, tile, probe);
  if (!extent) return tl::unexpected(extent.error());
  if (!*extent) return std::nullopt;
  const auto begin = static_cast<size_t>((*extent)->begin);
  const auto size = static_cast<size_t>((*extent)->end - (*extent)->begin);
  return TileRecord{BitString(stream.bytes(Section::kTile).subspan(begin, size)),
                    (stream.entry(Section::kTile).offset + begin) * 8};
}

}  // namespace

Result<std::optional<TileRecord>> find_record(const StreamView& stream, const BlockSite& site,
                                              const Probe& probe) {
  const Geometry& geometry = stream.geometry;
  const uint64_t image = geometry.image_number(site.level, {site.image_row, site.image_col});
  const uint64_t tile =
      geometry.tile_number(image, site.plane, site.bx / kTileBlocks, site.by / kTileBlocks);
  return load_record(stream, tile, probe);
}

TileContext tile_context(const StreamView& stream, const BlockSite& site) {
  const uint32_t tx = site.bx / kTileBlocks;
  const uint32_t ty = site.by / kTileBlocks;
  TileContext context;
  context.predictive = !stream.header.has(Feature::kMotionTiles) &&
                       !stream.geometry.is_reference(site.level, {site.image_row, site.image_col});
  context.blocks_inside = blocks_inside(stream.geometry.plane(site.plane), tx, ty);
  context.window = stream.header.window;
  context.depth = stream.header.depth;
  context.block_samples = uint64_t{stream.header.block_size()} * stream.header.block_size();
  context.steps = stream.header.has(Feature::kResidualStep);
  return context;
}

Result<std::optional<TileRecord>> find_motion_record(const StreamView& stream,
                                                     const MotionTilePlace& place,
                                                     const Probe& probe) {
  const Geometry& geometry = stream.geometry;
  const uint64_t image = geometry.image_number(place.level, place.image);
  return load_record(
      stream, geometry.motion_tile_number(image, place.motion_plane, place.tx, place.ty), probe);
}

MotionTileArea motion_tile_area(const StreamView& stream, const MotionTilePlace& place) {
  const MotionPlaneShape& plane = stream.geometry.motion_planes()[place.motion_plane];
  const uint32_t side = 1u << stream.header.motion_tile_log2;
  MotionTileArea area;
  area.x0 = place.tx * side;
  area.y0 = place.ty * side;
  area.width = std::min(side, plane.width - area.x0);
  area.height = std::min(side, plane.height - area.y0);
  return area;
}

}  // namespace hmlfc
