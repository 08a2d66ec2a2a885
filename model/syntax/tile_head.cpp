#include "syntax/tile_head.hpp"

#include <bit>

#include "arithmetic/bise.hpp"
#include "arithmetic/narrow.hpp"
#include "bits/bit_mask.hpp"

namespace hmlfc {
namespace {

enum MaskMode : int32_t { kMaskNone = 0, kMaskAll = 1, kMaskRaw = 2, kMaskQuads = 3 };
constexpr int32_t kSignsMixed = 2;
constexpr unsigned kMaxLevelBits = 6;

tl::unexpected<Error> tile_error(ErrorCode code, const FieldCursor& cursor) {
  return fail(code, Section::kTile, cursor.file_byte(cursor.position()));
}

uint64_t read_quad_mask(FieldCursor& cursor) {
  const uint32_t quads = static_cast<uint32_t>(cursor.take("quad_mask", "TIL-3", kQuadsInTile));
  uint64_t mask = 0;
  for (unsigned q = 0; q < kQuadsInTile; ++q) {
    if (!has_bit(quads, q)) continue;
    const int32_t blocks = cursor.take("quad_blocks", "TIL-3", kBlocksInQuad);
    mask |= static_cast<uint64_t>(blocks) << (kBlocksInQuad * q);
  }
  return mask;
}

uint64_t read_mask(FieldCursor& cursor, int32_t mode, uint64_t inside) {
  switch (mode) {
    case kMaskAll:
      return inside;
    case kMaskRaw:
      return cursor.take64("mask", "TIL-3");
    case kMaskQuads:
      return read_quad_mask(cursor);
    default:
      return 0;
  }
}

// min_x and codes_x, or min_y and codes_y (TIL-6).
Result<void> read_bounds(FieldCursor& cursor, const TileContext& context, char axis, int32_t& least,
                         Levels& levels) {
  const VectorWidths widths = vector_widths(context.window);
  const std::string_view min_name = axis == 'x' ? "min_x" : "min_y";
  const std::string_view code_name = axis == 'x' ? "codes_x" : "codes_y";
  least = cursor.take(min_name, "TIL-6", widths.component_bits, -context.window);
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  if (least > context.window) return tile_error(ErrorCode::kVectorRange, cursor);
  const unsigned code = static_cast<unsigned>(cursor.take(code_name, "TIL-6", widths.code_bits));
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  if (code > widths.max_code) return tile_error(ErrorCode::kBadLevels, cursor);
  levels = levels_of_code(code);
  return {};
}

Result<void> read_vectors(FieldCursor& cursor, const TileContext& context, uint64_t count,
                          TileVectors& vectors) {
  const int32_t sign_mode = cursor.take("sign_mode", "TIL-6", 2);
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  if (sign_mode > kSignsMixed) return tile_error(ErrorCode::kBadMode, cursor);
  vectors.sign_mode = static_cast<unsigned>(sign_mode);
  if (auto ok = read_bounds(cursor, context, 'x', vectors.min_x, vectors.levels_x); !ok) return ok;
  if (auto ok = read_bounds(cursor, context, 'y', vectors.min_y, vectors.levels_y); !ok) return ok;
  vectors.signs_at = cursor.position();
  cursor.skip(sign_mode == kSignsMixed ? count : 0);
  vectors.x_at = cursor.position();
  cursor.skip(bise_bits(vectors.levels_x, count));
  vectors.y_at = cursor.position();
  cursor.skip(bise_bits(vectors.levels_y, count));
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  return {};
}

Result<void> read_residuals(FieldCursor& cursor, const TileContext& context, uint64_t count,
                            TileResiduals& residuals) {
  residuals.level_base = static_cast<unsigned>(cursor.take("level_base", "TIL-8", 6));
  residuals.level_bits = static_cast<unsigned>(cursor.take("level_bits", "TIL-8", 3));
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  if (residuals.level_bits > kMaxLevelBits) return tile_error(ErrorCode::kBadMode, cursor);
  residuals.bias_bits = static_cast<unsigned>(cursor.take("bias_bits", "TIL-8", 4));
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  if (residuals.bias_bits > static_cast<unsigned>(context.depth) + 2) {
    return tile_error(ErrorCode::kBadMode, cursor);
  }
  if (context.steps) {
    residuals.step_base = static_cast<unsigned>(cursor.take("step_base", "STP-1", 4));
    residuals.step_bits = static_cast<unsigned>(cursor.take("step_bits", "STP-1", 2));
  }
  residuals.headers_at = cursor.position();
  cursor.skip(count * residuals.header_bits());
  residuals.values_at = cursor.position();
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  return {};
}

}  // namespace

Result<TileHead> read_tile_head(FieldCursor& cursor, const TileContext& context) {
  TileHead head;
  watch("bit position in a tile record", narrow<int64_t>(cursor.position()), context.depth);
  const int32_t motion_mode = context.predictive ? cursor.take("motion_mode", "TIL-1", 2) : 0;
  const int32_t residual_mode = cursor.take("residual_mode", "TIL-1", 2);
  head.motion_mask = read_mask(cursor, motion_mode, context.blocks_inside);
  head.residual_mask = read_mask(cursor, residual_mode, context.blocks_inside);
  if (cursor.overrun()) return tile_error(ErrorCode::kTileOverrun, cursor);
  // TIL-4
  if (((head.motion_mask | head.residual_mask) & ~context.blocks_inside) != 0) {
    return tile_error(ErrorCode::kMaskOutside, cursor);
  }
  head.vectors_begin = cursor.position();
  if (head.motion_mask != 0) {
    const auto count = static_cast<uint64_t>(std::popcount(head.motion_mask));
    if (auto ok = read_vectors(cursor, context, count, head.vectors); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  head.residuals_begin = cursor.position();
  if (head.residual_mask != 0) {
    const auto count = static_cast<uint64_t>(std::popcount(head.residual_mask));
    if (auto ok = read_residuals(cursor, context, count, head.residuals); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  return head;
}

}  // namespace hmlfc
