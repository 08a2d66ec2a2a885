#include "syntax/motion_tile.hpp"

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kLeastBlockLog2 = 2;

tl::unexpected<Error> motion_error(ErrorCode code, const FieldCursor& cursor) {
  return fail(code, Section::kTile, cursor.file_byte(cursor.position()));
}

PaletteEntry read_palette_entry(FieldCursor& cursor, const MotionContext& context,
                                unsigned explicit_bits) {
  PaletteEntry entry;
  if (context.two_references) {
    entry.reference_set = static_cast<unsigned>(cursor.take("reference_set", "MOT-3", 3));
  }
  entry.choice = static_cast<unsigned>(cursor.take("choice", "MOT-3", 4));
  if (!context.keyed) entry.negative = cursor.take("sign", "MOT-3", 1) != 0;
  const bool vector = entry.is(MotionChoice::kExplicitVector);
  if (vector || entry.is(MotionChoice::kExplicitDisparity)) {
    entry.explicit_x = cursor.take_signed("explicit_x", "MOT-3", explicit_bits);
  }
  if (vector) {
    entry.explicit_y = cursor.take_signed("explicit_y", "MOT-3", explicit_bits);
  }
  return entry;
}

}  // namespace

MotionContext motion_context(const StreamView& stream, const MotionTilePlace& place) {
  const MotionTileArea area = motion_tile_area(stream, place);
  const StreamHeader& header = stream.header;
  return {area.width,
          area.height,
          header.motion_tile_log2,
          header.block_size(),
          header.has(Feature::kTwoReferences),
          header.has(Feature::kSharedDisparity),
          stream.geometry.level(place.level).keyed};
}

Result<MotionHead> read_motion_head(FieldCursor& cursor, const MotionContext& context) {
  MotionHead head;
  head.block_log2 =
      kLeastBlockLog2 + static_cast<unsigned>(cursor.take("motion_block", "MOT-3", 2));
  head.entries = static_cast<unsigned>(cursor.take("palette_size", "MOT-3", 3)) + 1;
  const auto explicit_bits = static_cast<unsigned>(cursor.take("explicit_bits", "MOT-3", 4));
  if (cursor.overrun()) return motion_error(ErrorCode::kTileOverrun, cursor);
  if (explicit_bits > kMaxExplicitBits || (1u << head.block_log2) < context.block_size) {
    return motion_error(ErrorCode::kBadMode, cursor);
  }
  for (unsigned e = 0; e < head.entries; ++e) {
    head.palette[e] = read_palette_entry(cursor, context, explicit_bits);
  }
  head.columns = ceil_div(context.width, 1u << head.block_log2);
  head.rows = ceil_div(context.height, 1u << head.block_log2);
  head.levels = levels_of_code(level_code_for(head.entries));
  head.indices_at = cursor.position();
  cursor.skip(bise_bits(head.levels, head.blocks()));
  if (cursor.overrun()) return motion_error(ErrorCode::kTileOverrun, cursor);
  return head;
}

MotionHead empty_motion_head(const MotionContext& context) {
  MotionHead head;
  head.block_log2 = context.tile_log2;
  PaletteEntry& entry = head.palette[0];
  entry.reference_set = context.two_references ? 1 : 0;
  if (context.keyed) {
    entry.choice = static_cast<unsigned>(context.disparities ? MotionChoice::kOwnDisparity
                                                             : MotionChoice::kExplicitVector);
  }
  return head;
}

bool is_usable(const PaletteEntry& entry, const MotionContext& context) {
  if (entry.choice > static_cast<unsigned>(MotionChoice::kExplicitVector)) return false;
  const bool derived = entry.shares_disparity() || entry.is(MotionChoice::kExplicitDisparity);
  return context.disparities || !derived;
}

Result<PaletteEntry> palette_entry(const FieldCursor& cursor, const MotionHead& head,
                                   const MotionContext& context, uint32_t index) {
  if (index >= head.entries || !is_usable(head.palette[index], context)) {
    return motion_error(ErrorCode::kBadMode, cursor);
  }
  return head.palette[index];
}

Result<PaletteEntry> read_motion_entry(const FieldCursor& cursor, const MotionHead& head,
                                       const MotionContext& context, uint32_t x, uint32_t y) {
  const uint64_t block = uint64_t{y >> head.block_log2} * head.columns + (x >> head.block_log2);
  const uint32_t index =
      bise_value(cursor.record(), head.indices_at, head.levels, head.blocks(), block);
  const auto bits = static_cast<unsigned>(bise_bits(head.levels, 1));
  cursor.probe().field(Section::kTile, cursor.file_bit(head.indices_at), bits, "index", "MOT-3",
                       index);
  return palette_entry(cursor, head, context, index);
}

}  // namespace hmlfc
