#include "syntax/tile_record.hpp"

#include <bit>
#include <cstdlib>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/widths.hpp"
#include "bits/bit_string.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kMaxLevelBits = 6;

// min_x and codes_x, or min_y and codes_y (TIL-6).
Result<void> read_bounds(FieldCursor& cursor, const TileContext& context, std::string_view min_name,
                         std::string_view code_name, int32_t& min_value, Levels& levels) {
  const VectorWidths widths = vector_widths(context.window);
  min_value = cursor.take_offset(min_name, "TIL-6", widths.component_bits, -context.window);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (min_value > context.window) return cursor.error(ErrorCode::kVectorRange);
  const unsigned code = cursor.take(code_name, "TIL-6", widths.code_bits);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (code > widths.max_code) return cursor.error(ErrorCode::kBadLevels);
  levels = levels_of_code(code);
  return {};
}

Result<void> read_vectors(FieldCursor& cursor, const TileContext& context, uint64_t count,
                          TileVectors& vectors) {
  vectors.sign_mode = cursor.take("sign_mode", "TIL-6", 2);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (vectors.sign_mode > kSignsMixed) return cursor.error(ErrorCode::kBadMode);
  auto ok = read_bounds(cursor, context, "min_x", "codes_x", vectors.min_x, vectors.levels_x);
  if (ok) ok = read_bounds(cursor, context, "min_y", "codes_y", vectors.min_y, vectors.levels_y);
  if (!ok) return ok;
  vectors.signs_at = cursor.position();
  cursor.skip(vectors.sign_mode == kSignsMixed ? count : 0);
  vectors.x_at = cursor.position();
  cursor.skip(bise_bits(vectors.levels_x, count));
  vectors.y_at = cursor.position();
  cursor.skip(bise_bits(vectors.levels_y, count));
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  return {};
}

Result<void> read_residuals(FieldCursor& cursor, const TileContext& context, uint64_t count,
                            TileResiduals& residuals) {
  residuals.level_base = cursor.take("level_base", "TIL-8", 6);
  residuals.level_bits = cursor.take("level_bits", "TIL-8", 3);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (residuals.level_bits > kMaxLevelBits) return cursor.error(ErrorCode::kBadMode);
  residuals.bias_bits = cursor.take("bias_bits", "TIL-8", 4);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  if (residuals.bias_bits > static_cast<unsigned>(context.depth) + 2) {
    return cursor.error(ErrorCode::kBadMode);
  }
  if (context.steps) {
    residuals.step_base = cursor.take("step_base", "STP-1", 4);
    residuals.step_bits = cursor.take("step_bits", "STP-1", 2);
  }
  residuals.headers_at = cursor.position();
  cursor.skip(count * residuals.header_bits());
  residuals.values_at = cursor.position();
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  return {};
}

}  // namespace

TileContext tile_context(const StreamView& stream, const BlockSite& site) {
  const uint32_t tx = site.bx / kTileBlocks;
  const uint32_t ty = site.by / kTileBlocks;
  TileContext context;
  context.predictive = !stream.header.has(Feature::kMotionTiles) &&
                       !stream.geometry.is_reference(site.level, {site.image_row, site.image_col});
  context.blocks_inside = blocks_inside(stream.geometry.plane(site.plane), tx, ty);
  context.window = stream.header.window;
  context.depth = stream.header.depth;
  context.block_samples = uint64_t{stream.header.block_size()} * stream.header.block_size();
  context.steps = stream.header.has(Feature::kResidualStep);
  return context;
}

Result<TileHead> read_tile_head(FieldCursor& cursor, const TileContext& context) {
  TileHead head;
  watch("bit position in a tile record", narrow<int64_t>(cursor.position()), context.depth);
  const uint32_t motion_mode = context.predictive ? cursor.take("motion_mode", "TIL-1", 2) : 0;
  const uint32_t residual_mode = cursor.take("residual_mode", "TIL-1", 2);
  head.motion_mask = read_mask(cursor, motion_mode, context.blocks_inside);
  head.residual_mask = read_mask(cursor, residual_mode, context.blocks_inside);
  if (cursor.overrun()) return cursor.error(ErrorCode::kTileOverrun);
  // TIL-4
  if (((head.motion_mask | head.residual_mask) & ~context.blocks_inside) != 0) {
    return cursor.error(ErrorCode::kMaskOutside);
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

namespace {

BlockState state_of(bool motion, bool residual) {
  if (motion) return residual ? BlockState::kMotionResidual : BlockState::kMotion;
  return residual ? BlockState::kResidual : BlockState::kZero;
}

Result<void> read_vector(FieldCursor& cursor, const TileHead& head, const TileContext& context,
                         unsigned k, BlockEntry& entry) {
  const TileVectors& vectors = head.vectors;
  const unsigned m = rank(head.motion_mask, k);
  const auto count = static_cast<uint64_t>(std::popcount(head.motion_mask));
  entry.negative = vectors.sign_mode == kSignsMinus;
  if (vectors.sign_mode == kSignsMixed) {
    cursor.seek(vectors.signs_at + m);
    entry.negative = cursor.take("sign", "TIL-6", 1) != 0;
  }
  entry.dx = cursor.value("dx", "TIL-7", vectors.x_at, vectors.levels_x, count, m, vectors.min_x);
  entry.dy = cursor.value("dy", "TIL-7", vectors.y_at, vectors.levels_y, count, m, vectors.min_y);
  if (std::abs(entry.dx) > context.window || std::abs(entry.dy) > context.window) {
    return cursor.error_at(ErrorCode::kVectorRange, vectors.x_at);
  }
  watch("vector component", entry.dx);
  watch("vector component", entry.dy);
  return {};
}

// The level code and the step code of the block header at the cursor (TIL-8, STP-1).
Result<void> read_codes(FieldCursor& cursor, const TileResiduals& residuals,
                        const TileContext& context, BlockEntry& entry) {
  const uint64_t at = cursor.position();
  const unsigned code =
      residuals.level_base + cursor.take("level_delta", "TIL-8", residuals.level_bits);
  if (code > max_residual_level_code(context.depth)) {
    return cursor.error_at(ErrorCode::kBadLevels, at);
  }
  entry.levels = levels_of_code(code);
  if (!context.steps) return {};
  const unsigned step_code =
      residuals.step_base + cursor.take("step_delta", "STP-1", residuals.step_bits);
  if (step_code > kMaxStepCode) return cursor.error_at(ErrorCode::kBadLevels, at);
  entry.step = step_of_code(step_code);
  return {};
}

// Adds up the value sizes of the blocks before k, then reads the header of k (TIL-8, TIL-9).
Result<void> read_residual_header(FieldCursor& cursor, const TileHead& head,
                                  const TileContext& context, unsigned k, BlockEntry& entry) {
  const TileResiduals& residuals = head.residuals;
  const unsigned m = rank(head.residual_mask, k);
  entry.values_at = residuals.values_at;
  cursor.seek(residuals.headers_at);
  for (unsigned header = 0;; ++header) {
    if (auto ok = read_codes(cursor, residuals, context, entry); !ok) return ok;
    if (header == m) break;
    cursor.skip(residuals.bias_bits);
    entry.values_at += bise_bits(entry.levels, context.block_samples);
    cursor.probe().step();
  }
  entry.bias = cursor.take_signed("bias", "TIL-8", residuals.bias_bits);
  const uint64_t size = bise_bits(entry.levels, context.block_samples);
  if (!cursor.record().holds(entry.values_at, size)) {
    return cursor.error_at(ErrorCode::kTileOverrun, entry.values_at);
  }
  watch("bit position in a tile record", narrow<int64_t>(entry.values_at + size), context.depth);
  return {};
}

}  // namespace

Result<BlockEntry> read_block_entry(FieldCursor& cursor, const TileHead& head,
                                    const TileContext& context, unsigned k) {
  BlockEntry entry;
  entry.state = state_of(has_bit(head.motion_mask, k), has_bit(head.residual_mask, k));
  if (entry.has_motion()) {
    if (auto ok = read_vector(cursor, head, context, k, entry); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  if (entry.has_residual()) {
    if (auto ok = read_residual_header(cursor, head, context, k, entry); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  return entry;
}

namespace {

void put_vectors(BitWriter& writer, const VectorFields& vectors, int window) {
  const VectorWidths widths = vector_widths(window);
  writer.put(vectors.sign_mode, 2);
  writer.put(static_cast<uint32_t>(vectors.min_x + window), widths.component_bits);
  writer.put(vectors.x.level_code, widths.code_bits);
  writer.put(static_cast<uint32_t>(vectors.min_y + window), widths.component_bits);
  writer.put(vectors.y.level_code, widths.code_bits);
  if (vectors.sign_mode == kSignsMixed) {
    for (const bool minus : vectors.negative) writer.put(minus ? 1 : 0, 1);
  }
  put_sequence(writer, vectors.x);
  put_sequence(writer, vectors.y);
}

void put_residuals(BitWriter& writer, const ResidualFields& residuals, bool steps) {
  writer.put(residuals.level_base, 6);
  writer.put(residuals.level_bits, 3);
  writer.put(residuals.bias_bits, 4);
  if (steps) {
    writer.put(residuals.step_base, 4);
    writer.put(residuals.step_bits, 2);
  }
  for (const ResidualBlockFields& block : residuals.blocks) {
    writer.put(block.values.level_code - residuals.level_base, residuals.level_bits);
    if (steps) writer.put(block.step_code - residuals.step_base, residuals.step_bits);
    writer.put_signed(block.bias, residuals.bias_bits);
  }
  for (const ResidualBlockFields& block : residuals.blocks) put_sequence(writer, block.values);
}

}  // namespace

void put_sequence(BitWriter& writer, const SequenceFields& sequence) {
  const Levels levels = levels_of_code(sequence.level_code);
  if (sequence.codes.empty()) {
    bise_put(writer, levels, sequence.values);
  } else {
    bise_put_codes(writer, levels, sequence.values, sequence.codes);
  }
}

std::vector<uint8_t> write_tile_fields(const TileFields& tile, const TileContext& context) {
  BitWriter writer;
  if (context.predictive) writer.put(tile.motion_mode, 2);
  writer.put(tile.residual_mode, 2);
  if (context.predictive) put_mask(writer, tile.motion_mask, tile.motion_mode);
  put_mask(writer, tile.residual_mask, tile.residual_mode);
  if (tile.motion_mask != 0) put_vectors(writer, tile.vectors, context.window);
  if (tile.residual_mask != 0) put_residuals(writer, tile.residuals, context.steps);
  return writer.take();
}

}  // namespace hmlfc
