#include "syntax/motion_tile.hpp"

#include <algorithm>
#include <bit>

#include "arithmetic/motion.hpp"
#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kMinBlockLog2 = 2;
constexpr unsigned kMinDisparityBits = 13;
constexpr unsigned kDisparityCodeBits = 5;

// The samples of motion tile `place` that lie in the plane.
struct MotionTileSize {
  uint32_t width = 0;   // [1, S]
  uint32_t height = 0;  // [1, S]
};

MotionTileSize size_in_plane(const StreamView& stream, const MotionTilePlace& place) {
  const MotionPlaneShape& plane = stream.geometry.motion_planes()[place.motion_plane];
  const uint32_t side = 1u << stream.header.motion_tile_log2;
  return {std::min(side, plane.width - place.tx * side),
          std::min(side, plane.height - place.ty * side)};
}

PaletteEntry read_palette_entry(FieldCursor& cursor, const MotionContext& context,
                                unsigned explicit_bits) {
  PaletteEntry entry;
  if (context.two_references) {
    entry.reference_set = narrow<uint8_t>(cursor.take("reference_set", "MOT-3", 3));
  }
  entry.choice = narrow<uint8_t>(cursor.take("choice", "MOT-3", 4));
  if (!context.keyed) entry.negative = cursor.take("sign", "MOT-3", 1) != 0;
  const bool vector = entry.choice == kChoiceVector;
  if (vector || entry.choice == kChoiceDisparity) {
    entry.explicit_x = narrow<int16_t>(cursor.take_signed("explicit_x", "MOT-3", explicit_bits));
  }
  if (vector) {
    entry.explicit_y = narrow<int16_t>(cursor.take_signed("explicit_y", "MOT-3", explicit_bits));
  }
  return entry;
}

void put_palette_entry(BitWriter& writer, const PaletteEntry& entry, const PaletteFields& fields,
                       unsigned explicit_bits) {
  if (fields.reference_set) writer.put(entry.reference_set, 3);
  writer.put(entry.choice, 4);
  if (fields.sign) writer.put(entry.negative ? 1 : 0, 1);
  const bool vector = entry.choice == kChoiceVector;
  if (vector || entry.choice == kChoiceDisparity) {
    writer.put_signed(entry.explicit_x, explicit_bits);
  }
  if (vector) writer.put_signed(entry.explicit_y, explicit_bits);
}

}  // namespace

MotionContext motion_context(const StreamView& stream, const MotionTilePlace& place) {
  const MotionTileSize size = size_in_plane(stream, place);
  const StreamHeader& header = stream.header;
  return {size.width,
          size.height,
          header.motion_tile_log2,
          header.block_size(),
          header.has(Feature::kTwoReferences),
          header.has(Feature::kSharedDisparity),
          stream.geometry.level(place.level).keyed};
}

Result<MotionHead> read_motion_head(FieldCursor& cursor, const MotionContext& context) {
  MotionHead head;
  head.block_log2 = kMinBlockLog2 + cursor.take("motion_block", "MOT-3", 2);
  head.entries = cursor.take("palette_size", "MOT-3", 3) + 1;
  const uint32_t explicit_bits = cursor.take("explicit_bits", "MOT-3", 4);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (explicit_bits > kMaxExplicitBits || (1u << head.block_log2) < context.block_size) {
    return cursor.error(ErrorCode::kBadMode);
  }
  for (unsigned e = 0; e < head.entries; ++e) {
    head.palette[e] = read_palette_entry(cursor, context, explicit_bits);
  }
  head.columns = ceil_div(context.width, 1u << head.block_log2);
  head.rows = ceil_div(context.height, 1u << head.block_log2);
  head.levels = levels_of_code(level_code_for(head.entries));
  head.indices_at = cursor.position();
  cursor.skip(bise_bits(head.levels, head.blocks()));
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  return head;
}

MotionHead empty_motion_head(const MotionContext& context) {
  MotionHead head;
  head.block_log2 = context.tile_log2;
  PaletteEntry& entry = head.palette[0];
  entry.reference_set = context.two_references ? 1 : 0;
  if (context.keyed) entry.choice = context.disparities ? kChoiceOwn : kChoiceVector;
  return head;
}

bool is_usable(const PaletteEntry& entry, const MotionContext& context) {
  if (entry.choice > kChoiceVector) return false;
  const bool derived = entry.shares_disparity() || entry.choice == kChoiceDisparity;
  return context.disparities || !derived;
}

Result<PaletteEntry> read_motion_entry(const FieldCursor& cursor, const MotionHead& head,
                                       const MotionContext& context, uint32_t x, uint32_t y) {
  const uint64_t block = uint64_t{y >> head.block_log2} * head.columns + (x >> head.block_log2);
  const auto index = static_cast<uint32_t>(
      cursor.value("index", "MOT-3", head.indices_at, head.levels, head.blocks(), block));
  if (index >= head.entries || !is_usable(head.palette[index], context)) {
    return cursor.error(ErrorCode::kBadMode);
  }
  return head.palette[index];
}

void put_motion_fields(BitWriter& writer, const MotionTileFields& tile,
                       const PaletteFields& fields) {
  writer.put(tile.block_log2 - kMinBlockLog2, 2);
  writer.put(static_cast<uint32_t>(tile.palette.size() - 1), 3);
  writer.put(tile.explicit_bits, 4);
  for (const PaletteEntry& entry : tile.palette) {
    put_palette_entry(writer, entry, fields, tile.explicit_bits);
  }
  put_sequence(writer, tile.indices);
}

unsigned explicit_bits(const PaletteEntry& entry) {
  const auto bits = [](int32_t value) {
    const auto magnitude = static_cast<uint32_t>(value < 0 ? -value - 1 : value);
    return value == 0 ? 0 : static_cast<unsigned>(std::bit_width(magnitude)) + 1;
  };
  return std::max(bits(entry.explicit_x), bits(entry.explicit_y));
}

std::vector<uint8_t> write_motion_tile(const MotionTileCode& tile, const PaletteFields& fields) {
  if (tile.empty) return {};
  MotionTileFields record{tile.block_log2, 0, tile.palette, {}};
  for (const PaletteEntry& entry : tile.palette) {
    record.explicit_bits = std::max(record.explicit_bits, explicit_bits(entry));
  }
  record.indices.level_code = level_code_for(static_cast<uint32_t>(tile.palette.size()));
  record.indices.values.assign(tile.indices.begin(), tile.indices.end());
  BitWriter writer;
  put_motion_fields(writer, record, fields);
  return writer.take();
}

DisparityContext disparity_context(const StreamView& stream, const MotionTilePlace& place) {
  const MotionTileSize size = size_in_plane(stream, place);
  const uint32_t side = 1u << stream.header.disparity_grid_log2;
  return {ceil_div(size.width, side), ceil_div(size.height, side)};
}

Result<DisparityHead> read_disparity_head(FieldCursor& cursor, const DisparityContext& context) {
  DisparityHead head;
  head.min_disparity = cursor.take_signed("min_disparity", "MOT-6", kMinDisparityBits);
  const uint32_t code = cursor.take("disparity_code", "MOT-6", kDisparityCodeBits);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (code > kMaxDisparityCode) return cursor.error(ErrorCode::kBadLevels);
  head.levels = levels_of_code(code);
  head.values_at = cursor.position();
  cursor.skip(bise_bits(head.levels, context.blocks()));
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  return head;
}

Result<int32_t> read_disparity(const FieldCursor& cursor, const DisparityHead& head,
                               const DisparityContext& context, uint32_t gx, uint32_t gy) {
  const uint64_t block = uint64_t{gy} * context.columns + gx;
  const int32_t disparity = cursor.value("disparity", "MOT-6", head.values_at, head.levels,
                                         context.blocks(), block, head.min_disparity);
  if (disparity > kMaxDisparity) return cursor.error(ErrorCode::kVectorRange);
  return disparity;
}

void put_disparity_fields(BitWriter& writer, int32_t min_disparity, const SequenceFields& values) {
  writer.put_signed(min_disparity, kMinDisparityBits);
  writer.put(values.level_code, kDisparityCodeBits);
  put_sequence(writer, values);
}

std::vector<uint8_t> write_disparity_tile(std::span<const int16_t> values) {
  const auto [min, max] = std::ranges::minmax(values);
  if (min == 0 && max == 0) return {};
  SequenceFields above;
  above.level_code = level_code_for(static_cast<uint32_t>(max - min) + 1);
  for (const int16_t value : values) above.values.push_back(static_cast<uint32_t>(value - min));
  BitWriter writer;
  put_disparity_fields(writer, min, above);
  return writer.take();
}

}  // namespace hmlfc
