#include "syntax/tile_fields.hpp"

#include "arithmetic/bise.hpp"
#include "arithmetic/bise_codes.hpp"
#include "syntax/mask_writer.hpp"

namespace hmlfc {
namespace {

constexpr uint32_t kSignsMixed = 2;

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
