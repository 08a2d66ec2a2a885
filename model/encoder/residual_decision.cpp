#include "encoder/residual_decision.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <tuple>
#include <utility>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "bits/bit_string.hpp"
#include "encoder/residual_writer.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

// Level codes 1 to kCodes - 1 are tried: up to 128 levels.
constexpr unsigned kCodes = 19;
constexpr size_t kBlocks = size_t{kTileBlocks} * kTileBlocks;
constexpr int64_t kNever = std::numeric_limits<int64_t>::max() / 4;

// mask_mode 2, level_base 6, level_bits 3, bias_bits 4, step_base 4, step_bits 2.
constexpr int64_t kResidualHeadBits = 21;
// About what a block takes in a mask.
constexpr int64_t kMaskBitsPerBlock = 2;

// Nearest multiple of `step`, halves towards 0.
int32_t quantized(int32_t value, int32_t step) {
  const int32_t magnitude = (2 * (value < 0 ? -value : value) + step - 1) / (2 * step);
  return value < 0 ? -magnitude : magnitude;
}

int32_t lowest(const Levels& levels) { return -static_cast<int32_t>(levels.count >> 1); }
int32_t highest(const Levels& levels) {
  return lowest(levels) + static_cast<int32_t>(levels.count) - 1;
}

int64_t energy(const BlockValues& block) {
  int64_t sum = 0;
  for (const int32_t value : block.span()) sum += int64_t{value} * value;
  return sum;
}

// The costs of one block with one step: without residual, and with each level code.
struct BlockCosts {
  int64_t zero = 0;
  std::array<int64_t, kCodes> coded{};
};

// Costs of all blocks with one step.
class StepDecision {
 public:
  StepDecision(std::span<const BlockValues> differences, const TileContext& context, Lambda lambda,
               unsigned step_code)
      : differences_(differences),
        context_(context),
        lambda_(lambda),
        step_code_(step_code),
        step_(step_of_code(step_code)) {
    for (size_t k = 0; k < kBlocks; ++k) {
      if (has_bit(context_.blocks_inside, static_cast<unsigned>(k))) weigh(k);
    }
  }

  // Finds the cheapest mask and level codes, whose cost is cost().
  void run() {
    for (unsigned bits = 0; bits <= 4; ++bits) {
      for (unsigned base = 1; base + (1u << bits) <= kCodes; ++base) try_levels(base, bits);
    }
  }

  int64_t cost() const { return cost_; }

  ResidualTile tile() const {
    ResidualTile tile;
    tile.step_code = step_code_;
    for (size_t k = 0; k < kBlocks; ++k) {
      if (codes_[k] == 0) continue;
      const Levels levels = levels_of_code(codes_[k]);
      BlockValues block = differences_[k];
      for (size_t i = 0; i < block.size(); ++i) {
        block[i] = clamp(quantized(block[i], step_), lowest(levels), highest(levels));
      }
      const auto values = block.span();
      if (std::all_of(values.begin(), values.end(), [](int32_t v) { return v == 0; })) continue;
      tile.mask |= uint64_t{1} << k;
      tile.blocks.push_back(block);
    }
    return tile;
  }

 private:
  void weigh(size_t k) {
    const BlockValues& block = differences_[k];
    BlockCosts& costs = costs_[k];
    costs.coded.fill(kNever);
    costs.zero = lambda_.cost(energy(block), 0);
    // A code whose bits alone cost more than the cheapest so far is skipped.
    int64_t least = costs.zero;
    int64_t error = 0;
    bool clipped = true;
    for (unsigned code = 1; code < kCodes; ++code) {
      const Levels levels = levels_of_code(code);
      const auto bits = static_cast<int64_t>(bise_bits(levels, context_.block_samples));
      if (lambda_.cost(0, bits) > least) break;
      // More levels than needed only cost bits.
      if (clipped) std::tie(error, clipped) = quantisation_error(block, levels);
      costs.coded[code] = lambda_.cost(error, bits);
      least = std::min(least, costs.coded[code]);
    }
  }

  // The squared error that `levels` leave, and whether more levels would leave less.
  std::pair<int64_t, bool> quantisation_error(const BlockValues& block,
                                              const Levels& levels) const {
    int64_t error = 0;
    bool clipped = false;
    for (const int32_t value : block.span()) {
      const int32_t exact = quantized(value, step_);
      const int32_t kept = clamp(exact, lowest(levels), highest(levels));
      const int64_t left = value - int64_t{kept} * step_;
      error += left * left;
      clipped = clipped || kept != exact;
    }
    return {error, clipped};
  }

  void try_levels(unsigned base, unsigned bits) {
    const unsigned end = base + (1u << bits);
    std::array<uint8_t, kBlocks> codes{};
    int64_t total = 0;
    uint64_t mask = 0;
    for (size_t k = 0; k < kBlocks; ++k) {
      if (!has_bit(context_.blocks_inside, static_cast<unsigned>(k))) continue;
      const BlockCosts& costs = costs_[k];
      const auto best = std::min_element(costs.coded.begin() + base, costs.coded.begin() + end);
      const int64_t coded = *best + lambda_.cost(0, bits + kMaskBitsPerBlock);
      if (*best < kNever && coded < costs.zero) {
        codes[k] = static_cast<uint8_t>(best - costs.coded.begin());
        mask |= uint64_t{1} << k;
        total += *best + lambda_.cost(0, bits);
      } else {
        total += costs.zero;
      }
    }
    if (mask == 0) return;
    const uint32_t mode = mask_mode(mask, context_.blocks_inside);
    total += lambda_.cost(0, mask_bits(mask, mode) + kResidualHeadBits + kTileOverheadBits);
    if (total >= cost_) return;
    cost_ = total;
    codes_ = codes;
  }

  std::span<const BlockValues> differences_;
  const TileContext& context_;
  Lambda lambda_;
  unsigned step_code_;
  int32_t step_;
  std::array<BlockCosts, kBlocks> costs_;
  std::array<uint8_t, kBlocks> codes_{};
  int64_t cost_ = kNever;
};

ResidualTile exact_residuals(std::span<const BlockValues> differences, const TileContext& context) {
  ResidualTile tile;
  for (size_t k = 0; k < kBlocks; ++k) {
    if (!has_bit(context.blocks_inside, static_cast<unsigned>(k))) continue;
    if (energy(differences[k]) == 0) continue;
    tile.mask |= uint64_t{1} << k;
    tile.blocks.push_back(differences[k]);
  }
  return tile;
}

}  // namespace

ResidualTile decide_residuals(std::span<const BlockValues> differences, const TileContext& context,
                              const ResidualRules& rules) {
  if (rules.lossless) return exact_residuals(differences, context);
  int64_t best = 0;
  for (size_t k = 0; k < kBlocks; ++k) {
    if (has_bit(context.blocks_inside, static_cast<unsigned>(k))) {
      best += rules.lambda.cost(energy(differences[k]), 0);
    }
  }
  ResidualTile tile;
  // A tile whose whole error is worth less than a record stays empty.
  if (best <= rules.lambda.cost(0, kResidualHeadBits + kTileOverheadBits)) return tile;
  const unsigned first = rules.step_code - std::min(rules.step_code, rules.steps_around);
  const unsigned last = std::min(15u, rules.step_code + rules.steps_around);
  for (unsigned code = first; code <= last; ++code) {
    StepDecision decision(differences, context, rules.lambda, code);
    decision.run();
    if (decision.cost() >= best) continue;
    best = decision.cost();
    tile = decision.tile();
  }
  return tile;
}

std::vector<uint8_t> write_residual_tile(const ResidualTile& tile, const TileContext& context) {
  if (tile.mask == 0) return {};
  std::vector<const BlockValues*> blocks;
  for (const BlockValues& block : tile.blocks) blocks.push_back(&block);
  TileFields fields;
  fields.residual_mode = mask_mode(tile.mask, context.blocks_inside);
  fields.residual_mask = tile.mask;
  fields.residuals = residual_fields(blocks, context.depth, tile.step_code);
  TileContext with_steps = context;
  with_steps.steps = true;
  return write_tile_fields(fields, with_steps);
}

}  // namespace hmlfc
