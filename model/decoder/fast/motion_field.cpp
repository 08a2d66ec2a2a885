#include "decoder/fast/motion_field.hpp"

#include <algorithm>

#include "arithmetic/motion.hpp"
#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/fast/bise_unpack.hpp"
#include "decoder/golden/block_walk.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

// The values of a record, or nothing where it cannot be read.
std::vector<int32_t> disparities_of(const TileRecord& found, const DisparityContext& context) {
  const PaddedRecord record(found.bits.bytes());
  FieldCursor cursor(record.bits(), found.file_bit, Probe{});
  const auto head = read_disparity_head(cursor, context);
  if (!head) return {};
  std::vector<uint16_t> values(static_cast<size_t>(context.blocks()));
  bise_unpack(record.data(), head->values_at, head->levels, values.size(), values.data());
  std::vector<int32_t> disparities(values.size());
  std::transform(values.begin(), values.end(), disparities.begin(),
                 [&](uint16_t value) { return head->min_disparity + value; });
  return disparities;
}

}  // namespace

Result<void> read_motion_field(const StreamView& stream, const MotionTilePlace& place,
                               MotionField& field) {
  const MotionContext context = motion_context(stream, place);
  const auto found = find_motion_record(stream, place, Probe{});
  if (!found) return tl::unexpected(found.error());
  if (!*found) {
    field.head = empty_motion_head(context);
    field.usable[0] = true;
    field.indices[0] = 0;
    return {};
  }
  const PaddedRecord record((*found)->bits.bytes());
  FieldCursor cursor(record.bits(), (*found)->file_bit, Probe{});
  const auto head = read_motion_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  field.head = *head;
  for (unsigned e = 0; e < head->entries; ++e) {
    field.usable[e] = is_usable(head->palette[e], context);
  }
  bise_unpack(record.data(), head->indices_at, head->levels, static_cast<size_t>(head->blocks()),
              field.indices.data());
  return {};
}

Result<const PaletteEntry*> MotionEntries::find(const BlockSite& site) {
  const MotionPlace at = motion_place(stream_, site);
  const unsigned log2 = stream_.header.motion_tile_log2;
  const MotionTilePlace place{
      site.level, {site.image_row, site.image_col}, at.motion_plane, at.x >> log2, at.y >> log2};
  if (place != place_) {
    place_ = place;
    read_ = read_motion_field(stream_, place, field_);
  }
  if (!read_) return tl::unexpected(read_.error());
  const uint32_t in_tile = (1u << log2) - 1;
  return field_.entry((at.x & in_tile) >> field_.head.block_log2,
                      (at.y & in_tile) >> field_.head.block_log2);
}

DisparityPlane::DisparityPlane(const StreamView& stream, int level, ImagePos image,
                               size_t motion_plane)
    : stream_(stream),
      place_{level, image, motion_plane, 0, 0},
      columns_(ceil_div(stream.geometry.motion_planes()[motion_plane].width,
                        1u << stream.header.disparity_grid_log2)),
      tiles_x_(stream.geometry.motion_planes()[motion_plane].tiles_x),
      tile_log2_(stream.header.motion_tile_log2 - stream.header.disparity_grid_log2),
      values_(size_t{columns_} * ceil_div(stream.geometry.motion_planes()[motion_plane].height,
                                          1u << stream.header.disparity_grid_log2)),
      read_(static_cast<size_t>(stream.geometry.motion_planes()[motion_plane].tiles())) {}

void DisparityPlane::fill_tile(uint32_t tx, uint32_t ty) const {
  MotionTilePlace place = place_;
  place.tx = tx;
  place.ty = ty;
  const auto found = find_motion_record(stream_, place, Probe{});
  if (found && !*found) return;
  const DisparityContext context = disparity_context(stream_, place);
  std::vector<int32_t> disparities;
  if (found) disparities = disparities_of(**found, context);
  for (uint32_t gy = 0; gy < context.rows; ++gy) {
    int16_t* out = values_.data() + size_t{(ty << tile_log2_) + gy} * columns_ + (tx << tile_log2_);
    for (uint32_t gx = 0; gx < context.columns; ++gx) {
      const size_t i = size_t{gy} * context.columns + gx;
      const bool damaged = disparities.empty() || disparities[i] > kMaxDisparity;
      out[gx] = damaged ? kDamaged : narrow<int16_t>(disparities[i]);
    }
  }
}

}  // namespace hmlfc
