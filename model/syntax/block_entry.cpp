#include "syntax/block_entry.hpp"

#include <bit>
#include <cstdlib>

#include "arithmetic/bise.hpp"
#include "arithmetic/narrow.hpp"
#include "arithmetic/steps.hpp"
#include "bits/bit_mask.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kSignsMinus = 1;
constexpr unsigned kSignsMixed = 2;

tl::unexpected<Error> entry_error(ErrorCode code, const FieldCursor& cursor, uint64_t at) {
  return fail(code, Section::kTile, cursor.file_byte(at));
}

BlockState state_of(bool motion, bool residual) {
  if (motion) return residual ? BlockState::kMotionResidual : BlockState::kMotion;
  return residual ? BlockState::kResidual : BlockState::kZero;
}

// Component m of a vector sequence at bit `at` (TIL-7).
int32_t read_component(const FieldCursor& cursor, uint64_t at, const Levels& levels, uint64_t count,
                       unsigned m, int32_t least, std::string_view name) {
  const int32_t component =
      least + static_cast<int32_t>(bise_value(cursor.record(), at, levels, count, m));
  const auto bits = static_cast<unsigned>(bise_bits(levels, 1));
  cursor.probe().field(Section::kTile, cursor.file_bit(at), bits, name, "TIL-7", component);
  return component;
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
  entry.dx = read_component(cursor, vectors.x_at, vectors.levels_x, count, m, vectors.min_x, "dx");
  entry.dy = read_component(cursor, vectors.y_at, vectors.levels_y, count, m, vectors.min_y, "dy");
  if (std::abs(entry.dx) > context.window || std::abs(entry.dy) > context.window) {
    return entry_error(ErrorCode::kVectorRange, cursor, vectors.x_at);
  }
  watch("vector component", entry.dx);
  watch("vector component", entry.dy);
  return {};
}

// The level code and the step code of the block header at the cursor (TIL-8, STP-1).
Result<void> read_codes(FieldCursor& cursor, const TileResiduals& residuals,
                        const TileContext& context, BlockEntry& entry) {
  const uint64_t at = cursor.position();
  const unsigned code = residuals.level_base + static_cast<unsigned>(cursor.take(
                                                   "level_delta", "TIL-8", residuals.level_bits));
  if (code > max_residual_level_code(context.depth)) {
    return entry_error(ErrorCode::kBadLevels, cursor, at);
  }
  entry.levels = levels_of_code(code);
  if (!context.steps) return {};
  const unsigned step_code = residuals.step_base + static_cast<unsigned>(cursor.take(
                                                       "step_delta", "STP-1", residuals.step_bits));
  if (step_code > kMaxStepCode) return entry_error(ErrorCode::kBadLevels, cursor, at);
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
    return entry_error(ErrorCode::kTileOverrun, cursor, entry.values_at);
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

}  // namespace hmlfc
