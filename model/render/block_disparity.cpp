#include "render/block_disparity.hpp"

#include "decoder/golden/block_decoder.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/told_disparity.hpp"

namespace hmlfc {
namespace {

using Told = std::optional<BlockDisparity>;

// Returns the disparity of a reference image's own grid block, if it can be read.
Told told_by_reference(const StreamView& stream, const ToldDisparity& told, Probe probe) {
  const MotionPlace place = motion_place(stream, probe.site);
  const GridBlock block =
      grid_block(place.x, place.y, kChoiceOwn, stream.header.disparity_grid_log2,
                 stream.geometry.motion_planes()[place.motion_plane]);
  probe.site.tile = TileKind::kDisparity;
  const auto disparity = walk_to_disparity(stream, place.motion_plane, block, probe);
  if (!disparity) return std::nullopt;
  return told.shared(*disparity);
}

// Returns what the block at `probe.site` tells (GEO-3).
Result<Told> told_by_block(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  const ToldDisparity told(stream, site.level, {site.image_row, site.image_col});
  switch (told.source()) {
    case DisparitySource::kNone:
      break;
    case DisparitySource::kShared:
      return told_by_reference(stream, told, probe);
    case DisparitySource::kMotionTiles: {
      const auto motion = walk_to_coded_motion(stream, probe);
      if (!motion) return tl::unexpected(motion.error());
      return told.of_entry(motion->entry, motion->disparity);
    }
    case DisparitySource::kVectors: {
      const auto block = walk_to_block(stream, probe);
      if (!block) return tl::unexpected(block.error());
      if (block->entry.has_motion()) return told.of_vector(block->entry.dx, block->entry.dy);
      break;
    }
  }
  return Told{};
}

}  // namespace

Result<BlockDisparity> walk_to_block_disparity(const StreamView& stream, ViewPos view, uint32_t bx,
                                               uint32_t by, AccessCounts* counts) {
  const Geometry& geometry = stream.geometry;
  const int last = first_level(geometry, 0, {view.row, view.col});
  for (int level = 0; level <= last; ++level) {
    const ImagePos image = geometry.ancestor({view.row, view.col}, 0, level);
    const auto told =
        told_by_block(stream, {nullptr, counts, {level, image.row, image.col, Plane::kY, bx, by}});
    if (!told) return tl::unexpected(told.error());
    if (*told) return **told;
  }
  return BlockDisparity{};
}

Result<BlockDisparity> block_disparity(const Decoder& decoder, ViewPos view, uint32_t bx,
                                       uint32_t by, AccessCounts* counts) {
  const StreamView& stream = DecoderAccess::stream(decoder);
  const PlaneShape& plane = stream.geometry.plane(Plane::kY);
  if (view.row >= stream.header.rows || view.col >= stream.header.cols || bx >= plane.blocks_x ||
      by >= plane.blocks_y) {
    return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
  }
  return guard_request(stream.source,
                       [&] { return walk_to_block_disparity(stream, view, bx, by, counts); });
}

}  // namespace hmlfc
