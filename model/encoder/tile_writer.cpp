#include "encoder/tile_writer.hpp"

#include <algorithm>
#include <bit>

#include "bits/bit_mask.hpp"
#include "bits/bit_writer.hpp"
#include "encoder/residual_coding.hpp"
#include "values/bise.hpp"

namespace hmlfc {
namespace {

enum MaskMode : uint32_t { kMaskNone = 0, kMaskAll = 1, kMaskRaw = 2, kMaskQuads = 3 };
enum SignMode : uint32_t { kSignsPlus = 0, kSignsMinus = 1, kSignsMixed = 2 };

uint32_t quad_blocks(uint64_t mask, unsigned q) {
  return static_cast<uint32_t>((mask >> (kBlocksInQuad * q)) & 0xF);
}

uint32_t quad_mask(uint64_t mask) {
  uint32_t quads = 0;
  for (unsigned q = 0; q < kQuadsInTile; ++q) {
    quads |= static_cast<uint32_t>(quad_blocks(mask, q) != 0) << q;
  }
  return quads;
}

// The mode that takes the fewest bits (TIL-3).
uint32_t mask_mode(uint64_t mask, uint64_t inside) {
  if (mask == 0) return kMaskNone;
  if (mask == inside) return kMaskAll;
  const auto quads = static_cast<unsigned>(std::popcount(quad_mask(mask)));
  return kQuadsInTile + kBlocksInQuad * quads < 64 ? kMaskQuads : kMaskRaw;
}

void put_mask(BitWriter& writer, uint64_t mask, uint32_t mode) {
  if (mode == kMaskRaw) {
    writer.put(static_cast<uint32_t>(mask), 32);
    writer.put(static_cast<uint32_t>(mask >> 32), 32);
  } else if (mode == kMaskQuads) {
    const uint32_t quads = quad_mask(mask);
    writer.put(quads, kQuadsInTile);
    for (unsigned q = 0; q < kQuadsInTile; ++q) {
      if (has_bit(quads, q)) writer.put(quad_blocks(mask, q), kBlocksInQuad);
    }
  }
}

// One component of all vectors: bounds, then values (TIL-6).
struct ComponentCode {
  int32_t least = 0;
  unsigned code = 0;
  std::vector<uint32_t> values;
};

ComponentCode component_code(const std::vector<int32_t>& components) {
  const auto [least, most] = std::minmax_element(components.begin(), components.end());
  ComponentCode coded;
  coded.code = level_code_for(static_cast<uint32_t>(*most - *least) + 1);
  coded.least = *least;
  for (const int32_t component : components) {
    coded.values.push_back(static_cast<uint32_t>(component - coded.least));
  }
  return coded;
}

uint32_t sign_mode(const std::vector<bool>& negative) {
  const auto minus = std::count(negative.begin(), negative.end(), true);
  if (minus == 0) return kSignsPlus;
  return minus == std::ssize(negative) ? kSignsMinus : kSignsMixed;
}

void put_vectors(BitWriter& writer, std::span<const BlockChoice> choices, int window) {
  std::vector<int32_t> x;
  std::vector<int32_t> y;
  std::vector<bool> negative;
  for (const BlockChoice& choice : choices) {
    if (!choice.has_motion()) continue;
    x.push_back(choice.motion.dx);
    y.push_back(choice.motion.dy);
    negative.push_back(choice.motion.negative);
  }
  const VectorWidths widths = vector_widths(window);
  const ComponentCode coded_x = component_code(x);
  const ComponentCode coded_y = component_code(y);
  const uint32_t signs = sign_mode(negative);
  writer.put(signs, 2);
  for (const ComponentCode* coded : {&coded_x, &coded_y}) {
    writer.put(static_cast<uint32_t>(coded->least + window), widths.component_bits);
    writer.put(coded->code, widths.code_bits);
  }
  if (signs == kSignsMixed) {
    for (const bool minus : negative) writer.put(minus ? 1 : 0, 1);
  }
  bise_put(writer, levels_of_code(coded_x.code), coded_x.values);
  bise_put(writer, levels_of_code(coded_y.code), coded_y.values);
}

ResidualInterval interval_of(const BlockValues& residual) {
  const auto values = residual.span();
  const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
  return {*lo, *hi};
}

void put_values(BitWriter& writer, const BlockValues& residual, const BlockCode& code) {
  const Levels levels = levels_of_code(code.level_code);
  std::vector<uint32_t> values;
  for (const int32_t value : residual.span()) {
    const int32_t shifted = value - code.bias + static_cast<int32_t>(levels.count >> 1);
    values.push_back(static_cast<uint32_t>(shifted));
  }
  bise_put(writer, levels, values);
}

void put_residuals(BitWriter& writer, std::span<const BlockChoice> choices,
                   const TileContext& context) {
  std::vector<const BlockValues*> residuals;
  std::vector<ResidualInterval> intervals;
  for (const BlockChoice& choice : choices) {
    if (!choice.has_residual()) continue;
    residuals.push_back(&choice.residual);
    intervals.push_back(interval_of(choice.residual));
  }
  const ResidualCoding coding = best_coding(intervals, context.block_samples, context.depth);
  writer.put(coding.level_base, 6);
  writer.put(coding.level_bits, 3);
  writer.put(coding.bias_bits, 4);
  for (const BlockCode& block : coding.blocks) {
    writer.put(block.level_code - coding.level_base, coding.level_bits);
    writer.put_signed(block.bias, coding.bias_bits);
  }
  for (size_t i = 0; i < residuals.size(); ++i) put_values(writer, *residuals[i], coding.blocks[i]);
}

}  // namespace

std::vector<uint8_t> write_tile(std::span<const BlockChoice> choices, const TileContext& context) {
  uint64_t motion = 0;
  uint64_t residual = 0;
  for (size_t k = 0; k < choices.size(); ++k) {
    motion |= uint64_t{choices[k].has_motion()} << k;
    residual |= uint64_t{choices[k].has_residual()} << k;
  }
  if ((motion | residual) == 0) return {};
  BitWriter writer;
  const uint32_t motion_mode = mask_mode(motion, context.blocks_inside);
  const uint32_t residual_mode = mask_mode(residual, context.blocks_inside);
  if (context.predictive) writer.put(motion_mode, 2);
  writer.put(residual_mode, 2);
  if (context.predictive) put_mask(writer, motion, motion_mode);
  put_mask(writer, residual, residual_mode);
  if (motion != 0) put_vectors(writer, choices, context.window);
  if (residual != 0) put_residuals(writer, choices, context);
  return writer.take();
}

}  // namespace hmlfc
