#include "samples/block_walk.hpp"

#include "values/bise.hpp"
#include "values/reconstruct.hpp"

namespace hmlfc {
namespace {

// The residual of TIL-10 from the block's BISE values (TIL-9).
void read_residual(const FieldCursor& cursor, const BlockEntry& entry, const SampleRange& range,
                   BlockValues& residual) {
  const uint64_t count = residual.size();
  const auto bits = static_cast<unsigned>(bise_bits(entry.levels, 1));
  for (size_t i = 0; i < count; ++i) {
    const uint32_t value = bise_value(cursor.record(), entry.values_at, entry.levels, count, i);
    cursor.probe().field(Section::kTile, cursor.file_bit(entry.values_at), bits, "value", "TIL-9",
                         value);
    residual[i] = residual_of_value(value, entry.levels.count, entry.bias, range);
  }
}

}  // namespace

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

Result<CodedBlock> walk_to_block(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  const Geometry& geometry = stream.geometry;
  CodedBlock block{{}, BlockValues(geometry.block_size())};
  probe.walk();

  const uint64_t image = geometry.image_number(site.level, {site.image_row, site.image_col});
  const uint64_t tile =
      geometry.tile_number(image, site.plane, site.bx / kTileBlocks, site.by / kTileBlocks);
  const auto extent = find_tile(stream, tile, probe);
  if (!extent) return tl::unexpected(extent.error());
  if (!*extent) return block;

  const auto begin = static_cast<size_t>((*extent)->begin);
  const auto size = static_cast<size_t>((*extent)->end - (*extent)->begin);
  const BitString record(stream.bytes(Section::kTile).subspan(begin, size));
  const uint64_t file_bit = (stream.entry(Section::kTile).offset + begin) * 8;
  FieldCursor cursor(record, file_bit, probe);

  const TileContext context = tile_context(stream, site);
  const auto head = read_tile_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  const unsigned k = block_number(site.bx % kTileBlocks, site.by % kTileBlocks);
  const auto entry = read_block_entry(cursor, *head, context, k);
  if (!entry) return tl::unexpected(entry.error());
  block.entry = *entry;
  if (entry->has_residual()) {
    read_residual(cursor, *entry, sample_range(site.plane, stream.header.depth), block.residual);
  }
  return block;
}

}  // namespace hmlfc
