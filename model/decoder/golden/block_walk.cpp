#include "decoder/golden/block_walk.hpp"

#include "arithmetic/reconstruct.hpp"
#include "syntax/index.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {
namespace {

// The residual of TIL-10 and STP-3 from the block's BISE values (TIL-9).
void read_residual(const FieldCursor& cursor, const BlockEntry& entry, const SampleRange& range,
                   BlockValues& residual) {
  for (size_t i = 0; i < residual.size(); ++i) {
    const auto value = static_cast<uint32_t>(
        cursor.value("value", "TIL-9", entry.values_at, entry.levels, residual.size(), i));
    residual[i] = stepped_residual(value, entry.levels.count, entry.bias, entry.step, range);
  }
}

Probe probe_of(const Probe& probe, ImagePos image, TileKind kind) {
  BlockSite site = probe.site;
  site.image_row = image.row;
  site.image_col = image.col;
  site.tile = kind;
  return probe.at(site);
}

// The palette entry of the block at `probe.site` (MOT-3, MOT-4).
Result<PaletteEntry> walk_to_entry(const StreamView& stream, const MotionPlace& place,
                                   const Probe& probe) {
  const BlockSite& site = probe.site;
  const unsigned log2 = stream.header.motion_tile_log2;
  const MotionTilePlace tile{site.level,
                             {site.image_row, site.image_col},
                             place.motion_plane,
                             place.x >> log2,
                             place.y >> log2};
  const MotionContext context = motion_context(stream, tile);
  probe.walk();
  const auto record = find_motion_record(stream, tile, probe);
  if (!record) return tl::unexpected(record.error());
  if (!*record) return empty_motion_head(context).palette[0];
  FieldCursor cursor((*record)->bits, (*record)->file_bit, probe);
  const auto head = read_motion_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  const uint32_t in_tile = (1u << log2) - 1;
  return read_motion_entry(cursor, *head, context, place.x & in_tile, place.y & in_tile);
}

}  // namespace

Result<CodedBlock> walk_to_block(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  CodedBlock block{{}, BlockValues(stream.geometry.block_size())};
  probe.walk();
  const auto record = find_record(stream, site, probe);
  if (!record) return tl::unexpected(record.error());
  if (!*record) return block;

  FieldCursor cursor((*record)->bits, (*record)->file_bit, probe);
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

MotionPlace motion_place(const StreamView& stream, const BlockSite& site) {
  const size_t motion_plane = stream.geometry.motion_plane_of(site.plane);
  const bool doubled =
      site.plane != Plane::kY && stream.geometry.motion_planes()[motion_plane].halves;
  const unsigned shift = stream.header.block_log2 + (doubled ? 1 : 0);
  return {motion_plane, site.bx << shift, site.by << shift};
}

Result<CodedMotion> walk_to_coded_motion(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  const ImagePos image{site.image_row, site.image_col};
  const MotionPlace place = motion_place(stream, site);
  const auto entry = walk_to_entry(stream, place, probe_of(probe, image, TileKind::kMotion));
  if (!entry) return tl::unexpected(entry.error());
  if (!entry->shares_disparity()) return CodedMotion{*entry};
  const GridBlock block =
      grid_block(place.x, place.y, entry->choice, stream.header.disparity_grid_log2,
                 stream.geometry.motion_planes()[place.motion_plane]);
  const ImagePos reference = stream.geometry.reference_of(site.level, image);
  const auto disparity = walk_to_disparity(stream, place.motion_plane, block,
                                           probe_of(probe, reference, TileKind::kDisparity));
  if (!disparity) return tl::unexpected(disparity.error());
  return CodedMotion{*entry, *disparity};
}

Result<BlockMotion> walk_to_motion(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  const auto coded = walk_to_coded_motion(stream, probe);
  if (!coded) return tl::unexpected(coded.error());
  const MotionResolver resolver(stream, site.level, {site.image_row, site.image_col}, site.plane);
  return resolver.resolve(coded->entry, coded->disparity);
}

Result<int32_t> walk_to_disparity(const StreamView& stream, size_t motion_plane,
                                  const GridBlock& block, const Probe& probe) {
  const BlockSite& site = probe.site;
  const unsigned log2 = stream.header.motion_tile_log2 - stream.header.disparity_grid_log2;
  const MotionTilePlace tile{site.level,
                             {site.image_row, site.image_col},
                             motion_plane,
                             block.gx >> log2,
                             block.gy >> log2};
  probe.walk();
  const auto record = find_motion_record(stream, tile, probe);
  if (!record) return tl::unexpected(record.error());
  if (!*record) return 0;
  FieldCursor cursor((*record)->bits, (*record)->file_bit, probe);
  const DisparityContext context = disparity_context(stream, tile);
  const auto head = read_disparity_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  const uint32_t in_tile = (1u << log2) - 1;
  return read_disparity(cursor, *head, context, block.gx & in_tile, block.gy & in_tile);
}

}  // namespace hmlfc
