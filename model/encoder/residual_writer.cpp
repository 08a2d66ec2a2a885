#include "encoder/residual_writer.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"

namespace hmlfc {
namespace {

// Parameters and block codes of one tile.
struct ResidualCoding {
  unsigned level_base = 0;
  unsigned level_bits = 0;
  unsigned bias_bits = 0;
  std::vector<BlockCode> blocks;  // level codes in [level_base, level_base + 2^level_bits - 1]
  uint64_t bits = 0;              // of headers and values of all blocks
};

// The bias nearest to 0 with which N = `levels` levels reach all of `interval`, if there is one:
// values are in [bias - (N >> 1), bias + N - 1 - (N >> 1)] (TIL-10).
std::optional<int32_t> least_bias(const ResidualInterval& interval, uint32_t levels) {
  const auto below = static_cast<int32_t>(levels >> 1);
  const auto above = static_cast<int32_t>(levels) - 1 - below;
  const int32_t least = interval.hi - above;
  const int32_t most = interval.lo + below;
  if (least > most) return std::nullopt;
  return clamp(0, least, most);
}

// Decides level_base and level_bits of blocks whose codes may be raised but not lowered.
void decide_level_bits(ResidualCoding& coding, uint64_t block_samples) {
  const auto [least, most] =
      std::minmax_element(coding.blocks.begin(), coding.blocks.end(),
                          [](BlockCode a, BlockCode b) { return a.level_code < b.level_code; });
  const unsigned lowest = least->level_code;
  const unsigned highest = most->level_code;
  const auto widest = static_cast<unsigned>(std::bit_width(highest - lowest));
  coding.bits = ~uint64_t{0};
  for (unsigned bits = 0; bits <= widest; ++bits) {
    const unsigned span = (1u << bits) - 1;
    const unsigned base = std::max(lowest, highest > span ? highest - span : 0u);
    uint64_t total = coding.blocks.size() * bits;
    for (const BlockCode& block : coding.blocks) {
      const unsigned code = std::max(block.level_code, base);
      total += bise_bits(levels_of_code(code), block_samples);
    }
    if (total >= coding.bits) continue;
    coding.bits = total;
    coding.level_base = base;
    coding.level_bits = bits;
  }
}

ResidualInterval interval_of(const BlockValues& residual) {
  const auto values = residual.span();
  const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
  return {*lo, *hi};
}

SequenceFields values_of(const BlockValues& residual, const BlockCode& code) {
  SequenceFields sequence;
  sequence.level_code = code.level_code;
  const Levels levels = levels_of_code(code.level_code);
  for (const int32_t value : residual.span()) {
    const int32_t shifted = value - code.bias + static_cast<int32_t>(levels.count >> 1);
    sequence.values.push_back(static_cast<uint32_t>(shifted));
  }
  return sequence;
}

// The coding of least size for the blocks of a tile, at least one, of `block_samples` values each,
// at `depth` in [8, 12]. Exhaustive over bias_bits and level_bits; ties go to fewer bits of each.
ResidualCoding best_coding(std::span<const ResidualInterval> blocks, uint64_t block_samples,
                           int depth) {
  ResidualCoding best;
  best.bits = ~uint64_t{0};
  for (unsigned bias_bits = 0; bias_bits <= static_cast<unsigned>(depth) + 2; ++bias_bits) {
    ResidualCoding coding;
    coding.bias_bits = bias_bits;
    for (const ResidualInterval& block : blocks) {
      coding.blocks.push_back(least_code(block, bias_bits));
    }
    decide_level_bits(coding, block_samples);
    coding.bits += blocks.size() * bias_bits;
    if (coding.bits < best.bits) best = std::move(coding);
  }
  for (BlockCode& block : best.blocks) {
    block.level_code = std::max(block.level_code, best.level_base);
  }
  return best;
}

}  // namespace

BlockCode least_code(const ResidualInterval& interval, unsigned bias_bits) {
  unsigned code = level_code_for(static_cast<uint32_t>(interval.hi - interval.lo) + 1);
  for (;; ++code) {
    const auto bias = least_bias(interval, levels_of_code(code).count);
    if (bias && fits_signed(*bias, bias_bits)) return {code, *bias};
  }
}

ResidualFields residual_fields(std::span<const BlockValues> blocks, int depth) {
  std::vector<ResidualInterval> intervals;
  for (const BlockValues& block : blocks) intervals.push_back(interval_of(block));
  const ResidualCoding coding = best_coding(intervals, blocks.front().size(), depth);
  ResidualFields fields;
  fields.level_base = coding.level_base;
  fields.level_bits = coding.level_bits;
  fields.bias_bits = coding.bias_bits;
  for (size_t i = 0; i < blocks.size(); ++i) {
    const BlockCode& code = coding.blocks[i];
    fields.blocks.push_back({0, code.bias, values_of(blocks[i], code)});
  }
  return fields;
}

}  // namespace hmlfc
