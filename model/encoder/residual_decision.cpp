#include "encoder/residual_decision.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <numeric>
#include <utility>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "encoder/residual_writer.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

constexpr size_t kBlocks = size_t{kTileBlocks} * kTileBlocks;
constexpr unsigned kMaxStepBits = 2;
constexpr unsigned kMaxLevelBits = 5;

int64_t energy(const BlockValues& block) {
  int64_t sum = 0;
  for (const int32_t value : block.span()) sum += int64_t{value} * value;
  return sum;
}

// A block that may get a residual: its costs by step, then width of the bias, and the least each.
struct Candidate {
  size_t block = 0;
  ResidualCosts weighed;
  std::vector<LevelCosts> costs;
  std::vector<int64_t> least;
};

// The head of a tile's record. Steps count from the first one tried.
struct Head {
  unsigned first_step = 0;
  unsigned step_bits = 0;
  size_t bias = 0;  // of kTriedBiasBits
  unsigned level_base = 0;
  unsigned level_bits = 0;

  unsigned header_bits() const { return level_bits + step_bits + kTriedBiasBits[bias]; }
};

// The cheapest head of one tile, and what each block gets with it.
class HeadSearch {
 public:
  HeadSearch(std::span<const BlockValues> differences, const TileContext& context,
             const ResidualRules& rules)
      : differences_(differences),
        context_(context),
        lambda_(rules.lambda),
        widths_(rules.bias_widths),
        codes_(std::min(rules.level_codes, max_residual_level_code(context.depth) + 1)),
        first_step_(rules.step_code - std::min(rules.step_code, rules.steps_below)),
        steps_(std::min(kMaxStepCode, rules.step_code + rules.steps_above) - first_step_ + 1) {}

  ResidualTile run() {
    if (!collect()) return {};
    for (size_t bias = 0; bias < widths_; ++bias) {
      for (unsigned bits = 0; bits <= kMaxStepBits; ++bits) {
        for (unsigned step = 0; step + (1u << bits) <= steps_; ++step) try_steps(step, bits, bias);
      }
    }
    return tile();
  }

 private:
  // Weighs the blocks that may be worth a residual. False: all together they are not worth a head.
  bool collect() {
    const int64_t least = lambda_.cost(0, kMaskBitsPerBlock);
    const int64_t head = lambda_.cost(0, kLeastResidualBits);
    std::array<int64_t, kBlocks> worth{};  // what a block could save at most
    int64_t most = 0;
    for (size_t k = 0; k < kBlocks; ++k) {
      if (!has_bit(context_.blocks_inside, static_cast<unsigned>(k))) continue;
      worth[k] = std::max<int64_t>(0, most_saved(differences_[k]) - least);
      most += worth[k];
    }
    if (most <= head) return false;
    most = 0;
    unsigned useful = 0;
    for (size_t k = 0; k < kBlocks; ++k) {
      if (worth[k] == 0) continue;
      Candidate& candidate =
          candidates_.emplace_back(Candidate{k, {differences_[k], lambda_}, {}, {}});
      candidate.costs.resize(steps_ * widths_);
      unsigned codes = 0;
      for (unsigned s = 0; s < steps_; ++s) {
        const auto costs = std::span(candidate.costs).subspan(s * widths_, widths_);
        codes =
            std::max(codes, candidate.weighed.weigh(step_of_code(first_step_ + s), codes_, costs));
      }
      for (const LevelCosts& row : candidate.costs) {
        candidate.least.push_back(*std::ranges::min_element(row));
      }
      const int64_t best = *std::ranges::min_element(candidate.least);
      const int64_t saved = candidate.weighed.zero() - best - least;
      if (saved <= 0) {
        candidates_.pop_back();
        continue;
      }
      most += saved;
      useful = std::max(useful, codes);
    }
    while (level_bits_ < kMaxLevelBits && (2u << level_bits_) < useful) ++level_bits_;
    // So far may fields reach that begin with a useful code.
    codes_ = std::min(codes_, useful + (1u << level_bits_) - 1);
    return most > head;
  }

  // By one level, which takes the mean away and no bits, or by more of them, which take some.
  int64_t most_saved(const BlockValues& block) const {
    const auto values = block.span();
    const int64_t sum = std::accumulate(values.begin(), values.end(), int64_t{0});
    const auto bits = static_cast<int64_t>(bise_bits(levels_of_code(1), block.size()));
    return std::max(lambda_.cost(sum * sum / static_cast<int64_t>(block.size()) + 1, 0),
                    lambda_.cost(energy(block), -bits));
  }

  // What `head` would save if every block had its best level code.
  int64_t most_gained(const Head& head) const {
    const int64_t header = lambda_.cost(0, head.header_bits() + kMaskBitsPerBlock);
    int64_t gain = 0;
    for (const Candidate& candidate : candidates_) {
      int64_t least = kNever;
      for (unsigned s = head.first_step; s < head.first_step + (1u << head.step_bits); ++s) {
        least = std::min(least, candidate.least[s * widths_ + head.bias]);
      }
      gain += std::max<int64_t>(0, candidate.weighed.zero() - header - least);
    }
    return gain;
  }

  // All level_base and level_bits with steps [step, step + 2^step_bits - 1] and one bias width.
  void try_steps(unsigned step, unsigned step_bits, size_t bias) {
    std::array<std::array<int64_t, kLevelCodes>, kMaxLevelBits + 1> gains{};
    Head head{step, step_bits, bias, 0, 0};
    if (most_gained(head) <= best_gain_) return;
    for (const Candidate& candidate : candidates_) {
      LevelCosts row = candidate.costs[step * widths_ + bias];
      for (unsigned s = step + 1; s < step + (1u << step_bits); ++s) {
        const LevelCosts& other = candidate.costs[s * widths_ + bias];
        for (size_t c = 0; c < codes_; ++c) row[c] = std::min(row[c], other[c]);
      }
      const int64_t most = candidate.weighed.zero();
      for (unsigned bits = 0; bits <= level_bits_; ++bits) {
        head.level_bits = bits;
        const int64_t spent = most - lambda_.cost(0, head.header_bits() + kMaskBitsPerBlock);
        for (size_t c = 0; c < codes_; ++c) gains[bits][c] += std::max<int64_t>(0, spent - row[c]);
        // Now row[c] is the least of codes c to c + 2^(bits + 1) - 1.
        const size_t half = size_t{1} << bits;
        for (size_t c = 0; c + half < codes_; ++c) row[c] = std::min(row[c], row[c + half]);
      }
    }
    for (unsigned bits = 0; bits <= level_bits_; ++bits) {
      for (unsigned base = 0; base + (1u << bits) <= codes_; ++base) {
        if (gains[bits][base] <= best_gain_) continue;
        best_gain_ = gains[bits][base];
        best_ = {step, step_bits, bias, base, bits};
      }
    }
  }

  // The tile with the best head, if that costs less than no residual.
  ResidualTile tile() {
    ResidualTile tile;
    if (best_gain_ == 0) return tile;
    tile.fields.level_base = best_.level_base;
    tile.fields.level_bits = best_.level_bits;
    tile.fields.bias_bits = kTriedBiasBits[best_.bias];
    tile.fields.step_base = first_step_ + best_.first_step;
    tile.fields.step_bits = best_.step_bits;
    const int64_t header = lambda_.cost(0, best_.header_bits());
    int64_t gain = 0;
    for (Candidate& candidate : candidates_) {
      const Choice choice = cheapest(candidate);
      const int64_t own = candidate.weighed.zero() - choice.cost - header;
      if (own <= lambda_.cost(0, kMaskBitsPerBlock)) continue;
      gain += own;
      tile.mask |= uint64_t{1} << candidate.block;
      add_block(candidate, choice, tile);
    }
    const uint32_t mode = mask_mode(tile.mask, context_.blocks_inside);
    const int64_t bits = mask_bits(tile.mask, mode) + kLeastResidualBits;
    if (gain <= lambda_.cost(0, bits)) return {};
    return tile;
  }

  struct Choice {
    int64_t cost = kNever;
    unsigned step_code = 0;
    unsigned level_code = 0;
  };

  Choice cheapest(const Candidate& candidate) const {
    Choice best;
    for (unsigned s = best_.first_step; s < best_.first_step + (1u << best_.step_bits); ++s) {
      const LevelCosts& row = candidate.costs[s * widths_ + best_.bias];
      for (unsigned c = best_.level_base; c < best_.level_base + (1u << best_.level_bits); ++c) {
        if (row[c] < best.cost) best = {row[c], first_step_ + s, c};
      }
    }
    return best;
  }

  void add_block(Candidate& candidate, const Choice& choice, ResidualTile& tile) const {
    const int32_t step = step_of_code(choice.step_code);
    const uint32_t levels = levels_of_code(choice.level_code).count;
    ResidualBlockFields fields;
    fields.step_code = choice.step_code;
    fields.bias = candidate.weighed.best_bias(step, choice.level_code, kTriedBiasBits[best_.bias]);
    fields.values.level_code = choice.level_code;
    const int32_t lo = lowest_level(levels) + fields.bias;
    BlockValues block = differences_[candidate.block];
    for (size_t i = 0; i < block.size(); ++i) {
      const int32_t kept =
          clamp(quantized(block[i], step), lo, lo + static_cast<int32_t>(levels) - 1);
      fields.values.values.push_back(static_cast<uint32_t>(kept - lo));
      block[i] = kept * step;
    }
    tile.fields.blocks.push_back(std::move(fields));
    tile.blocks.push_back(block);
  }

  std::span<const BlockValues> differences_;
  const TileContext& context_;
  Lambda lambda_;
  size_t widths_;            // of the bias
  unsigned codes_;           // of levels
  unsigned level_bits_ = 3;  // at most
  unsigned first_step_;
  unsigned steps_;
  std::deque<Candidate> candidates_;
  int64_t best_gain_ = 0;
  Head best_;
};

ResidualTile exact_residuals(std::span<const BlockValues> differences, const TileContext& context) {
  ResidualTile tile;
  for (size_t k = 0; k < kBlocks; ++k) {
    if (!has_bit(context.blocks_inside, static_cast<unsigned>(k))) continue;
    if (energy(differences[k]) == 0) continue;
    tile.mask |= uint64_t{1} << k;
    tile.blocks.push_back(differences[k]);
  }
  if (!tile.blocks.empty()) tile.fields = residual_fields(tile.blocks, context.depth);
  return tile;
}

}  // namespace

ResidualTile decide_residuals(std::span<const BlockValues> differences, const TileContext& context,
                              const ResidualRules& rules) {
  if (rules.lossless) return exact_residuals(differences, context);
  return HeadSearch(differences, context, rules).run();
}

std::vector<uint8_t> write_residual_tile(const ResidualTile& tile, const TileContext& context) {
  if (tile.mask == 0) return {};
  TileFields fields;
  fields.residual_mode = mask_mode(tile.mask, context.blocks_inside);
  fields.residual_mask = tile.mask;
  fields.residuals = tile.fields;
  TileContext with_steps = context;
  with_steps.steps = true;
  return write_tile_fields(fields, with_steps);
}

}  // namespace hmlfc
