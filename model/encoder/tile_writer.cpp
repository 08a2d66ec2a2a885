#include "encoder/tile_writer.hpp"

#include <algorithm>

#include "encoder/residual_writer.hpp"
#include "syntax/tile_masks.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

// One component of all vectors above the least of them (TIL-6).
SequenceFields component_fields(const std::vector<int32_t>& components, int32_t& least) {
  const auto [low, high] = std::minmax_element(components.begin(), components.end());
  least = *low;
  SequenceFields coded;
  coded.level_code = level_code_for(static_cast<uint32_t>(*high - *low) + 1);
  for (const int32_t component : components) {
    coded.values.push_back(static_cast<uint32_t>(component - least));
  }
  return coded;
}

uint32_t sign_mode(const std::vector<bool>& negative) {
  const auto minus = std::count(negative.begin(), negative.end(), true);
  if (minus == 0) return kSignsPlus;
  return minus == std::ssize(negative) ? kSignsMinus : kSignsMixed;
}

VectorFields vector_fields(std::span<const BlockDecision> decisions) {
  VectorFields fields;
  std::vector<int32_t> x;
  std::vector<int32_t> y;
  for (const BlockDecision& decision : decisions) {
    if (!decision.has_motion()) continue;
    x.push_back(decision.motion.dx);
    y.push_back(decision.motion.dy);
    fields.negative.push_back(decision.motion.negative);
  }
  fields.sign_mode = sign_mode(fields.negative);
  fields.x = component_fields(x, fields.min_x);
  fields.y = component_fields(y, fields.min_y);
  return fields;
}

ResidualFields residuals_of(std::span<const BlockDecision> decisions, int depth) {
  std::vector<BlockValues> residuals;
  for (const BlockDecision& decision : decisions) {
    if (decision.has_residual()) residuals.push_back(decision.residual);
  }
  return residual_fields(residuals, depth);
}

}  // namespace

std::vector<uint8_t> write_tile(std::span<const BlockDecision> decisions,
                                const TileContext& context) {
  TileFields tile;
  for (size_t k = 0; k < decisions.size(); ++k) {
    tile.motion_mask |= uint64_t{decisions[k].has_motion()} << k;
    tile.residual_mask |= uint64_t{decisions[k].has_residual()} << k;
  }
  if ((tile.motion_mask | tile.residual_mask) == 0) return {};
  tile.motion_mode = mask_mode(tile.motion_mask, context.blocks_inside);
  tile.residual_mode = mask_mode(tile.residual_mask, context.blocks_inside);
  if (tile.motion_mask != 0) tile.vectors = vector_fields(decisions);
  if (tile.residual_mask != 0) tile.residuals = residuals_of(decisions, context.depth);
  return write_tile_fields(tile, context);
}

}  // namespace hmlfc
