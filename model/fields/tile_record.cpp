#include "fields/tile_record.hpp"

#include "fields/index.hpp"
#include "fields/tile_layout.hpp"

namespace hmlfc {

Result<std::optional<TileRecord>> find_record(const StreamView& stream, const BlockSite& site,
                                              const Probe& probe) {
  const Geometry& geometry = stream.geometry;
  const uint64_t image = geometry.image_number(site.level, {site.image_row, site.image_col});
  const uint64_t tile =
      geometry.tile_number(image, site.plane, site.bx / kTileBlocks, site.by / kTileBlocks);
  const auto extent = find_tile(stream, tile, probe);
  if (!extent) return tl::unexpected(extent.error());
  if (!*extent) return std::nullopt;
  const auto begin = static_cast<size_t>((*extent)->begin);
  const auto size = static_cast<size_t>((*extent)->end - (*extent)->begin);
  return TileRecord{BitString(stream.bytes(Section::kTile).subspan(begin, size)),
                    (stream.entry(Section::kTile).offset + begin) * 8};
}

TileContext tile_context(const StreamView& stream, const BlockSite& site) {
  const uint32_t tx = site.bx / kTileBlocks;
  const uint32_t ty = site.by / kTileBlocks;
  TileContext context;
  context.predictive = !stream.geometry.is_reference(site.level, {site.image_row, site.image_col});
  context.blocks_inside = blocks_inside(stream.geometry.plane(site.plane), tx, ty);
  context.window = stream.header.window;
  context.depth = stream.header.depth;
  context.block_samples = uint64_t{stream.header.block_size()} * stream.header.block_size();
  return context;
}

}  // namespace hmlfc
