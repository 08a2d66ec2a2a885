#include "encoder/tile_writer.hpp"

#include <algorithm>
#include <optional>

#include "bits/bit_writer.hpp"
#include "encoder/mask_writer.hpp"
#include "encoder/residual_writer.hpp"
#include "values/bise.hpp"

namespace hmlfc {
namespace {

enum SignMode : uint32_t { kSignsPlus = 0, kSignsMinus = 1, kSignsMixed = 2 };

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

void put_residuals(BitWriter& writer, std::span<const BlockChoice> choices,
                   const TileContext& context) {
  std::vector<const BlockValues*> residuals;
  for (const BlockChoice& choice : choices) {
    if (choice.has_residual()) residuals.push_back(&choice.residual);
  }
  put_residual_blocks(writer, residuals, context.depth, std::nullopt);
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
