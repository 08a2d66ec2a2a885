#include "syntax/disparity_tile.hpp"

#include <array>

#include "arithmetic/bise.hpp"
#include "arithmetic/disparity.hpp"
#include "arithmetic/rounding.hpp"

namespace hmlfc {
namespace {

tl::unexpected<Error> disparity_error(ErrorCode code, const FieldCursor& cursor) {
  return fail(code, Section::kTile, cursor.file_byte(cursor.position()));
}

// Where choices 1 to 9 look, in grid blocks (MOT-5).
struct Direction {
  int8_t dx;
  int8_t dy;
};
constexpr std::array<Direction, 9> kDirections{
    {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

}  // namespace

DisparityContext disparity_context(const StreamView& stream, const MotionTilePlace& place) {
  const MotionTileArea area = motion_tile_area(stream, place);
  const uint32_t side = 1u << stream.header.disparity_grid_log2;
  return {ceil_div(area.width, side), ceil_div(area.height, side)};
}

Result<DisparityHead> read_disparity_head(FieldCursor& cursor, const DisparityContext& context) {
  DisparityHead head;
  head.least = cursor.take_signed("min_disparity", "MOT-6", 13);
  const auto code = static_cast<unsigned>(cursor.take("disparity_code", "MOT-6", 5));
  if (cursor.overrun()) return disparity_error(ErrorCode::kTileOverrun, cursor);
  if (code > kMaxDisparityCode) return disparity_error(ErrorCode::kBadLevels, cursor);
  head.levels = levels_of_code(code);
  head.values_at = cursor.position();
  cursor.skip(bise_bits(head.levels, context.blocks()));
  if (cursor.overrun()) return disparity_error(ErrorCode::kTileOverrun, cursor);
  return head;
}

Result<int32_t> read_disparity(const FieldCursor& cursor, const DisparityHead& head,
                               const DisparityContext& context, uint32_t gx, uint32_t gy) {
  const uint64_t block = uint64_t{gy} * context.columns + gx;
  const int32_t disparity =
      head.least + static_cast<int32_t>(bise_value(cursor.record(), head.values_at, head.levels,
                                                   context.blocks(), block));
  const auto bits = static_cast<unsigned>(bise_bits(head.levels, 1));
  cursor.probe().field(Section::kTile, cursor.file_bit(head.values_at), bits, "disparity", "MOT-6",
                       disparity);
  if (disparity > kMaxDisparity) return disparity_error(ErrorCode::kVectorRange, cursor);
  return disparity;
}

GridBlock grid_block(uint32_t x, uint32_t y, unsigned choice, unsigned grid_log2,
                     const MotionPlaneShape& plane) {
  const Direction direction = kDirections[choice - 1];
  const auto place = [&](uint32_t sample, int32_t steps, uint32_t size) {
    const auto last = static_cast<int32_t>((size - 1) >> grid_log2);
    const auto own = static_cast<int32_t>(sample >> grid_log2);
    return static_cast<uint32_t>(clamp(own + steps, 0, last));
  };
  return {place(x, direction.dx, plane.width), place(y, direction.dy, plane.height)};
}

}  // namespace hmlfc
