#include "samples/disparity_plane.hpp"

#include <algorithm>

#include "samples/padded_record.hpp"
#include "values/disparity.hpp"
#include "values/rounding.hpp"

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
                 [&](uint16_t value) { return head->least + value; });
  return disparities;
}

}  // namespace

DisparityPlane DisparityPlane::read(const StreamView& stream, int level, ImagePos image,
                                    size_t motion_plane) {
  const MotionPlaneShape& shape = stream.geometry.motion_planes()[motion_plane];
  const uint32_t side = 1u << stream.header.disparity_grid_log2;
  DisparityPlane plane;
  plane.columns_ = ceil_div(shape.width, side);
  plane.values_.resize(size_t{plane.columns_} * ceil_div(shape.height, side));
  for (uint32_t ty = 0; ty < shape.tiles_y; ++ty) {
    for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
      plane.read_tile(stream, {level, image, motion_plane, tx, ty});
    }
  }
  return plane;
}

void DisparityPlane::read_tile(const StreamView& stream, const MotionTilePlace& place) {
  const auto found = find_motion_record(stream, place, Probe{});
  if (found && !*found) return;
  const DisparityContext context = disparity_context(stream, place);
  std::vector<int32_t> disparities;
  if (found) disparities = disparities_of(**found, context);
  const unsigned log2 = stream.header.motion_tile_log2 - stream.header.disparity_grid_log2;
  for (uint32_t gy = 0; gy < context.rows; ++gy) {
    int16_t* out = values_.data() + size_t{(place.ty << log2) + gy} * columns_ + (place.tx << log2);
    for (uint32_t gx = 0; gx < context.columns; ++gx) {
      const size_t i = size_t{gy} * context.columns + gx;
      const bool damaged = disparities.empty() || disparities[i] > kMaxDisparity;
      out[gx] = damaged ? kDamaged : static_cast<int16_t>(disparities[i]);
    }
  }
}

}  // namespace hmlfc
