// The residuals decided for a tile: their cost against exhaustive search and against their own
// record.
#include "encoder/residual_decision.hpp"

#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "bits/bit_string.hpp"
#include "encoder/residual_writer.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kBlocks = 64;

TileContext context_of(uint64_t inside) {
  TileContext context;
  context.depth = 8;
  context.block_samples = 16;
  context.blocks_inside = inside;
  return context;
}

std::vector<BlockValues> draw_blocks(std::mt19937& random, int amplitude) {
  std::vector<BlockValues> blocks(kBlocks, BlockValues(4));
  for (BlockValues& block : blocks) {
    const int scale = random() % 3 == 0 ? amplitude : 2;
    for (size_t i = 0; i < block.size(); ++i) {
      block[i] = static_cast<int32_t>(random() % static_cast<unsigned>(2 * scale + 1)) - scale;
    }
  }
  return blocks;
}

// D + lambda R of a tile as it is decoded, its record counted in bits.
int64_t cost_of(const ResidualTile& tile, const std::vector<BlockValues>& blocks,
                const TileContext& context, Lambda lambda) {
  int64_t error = 0;
  size_t m = 0;
  for (unsigned k = 0; k < kBlocks; ++k) {
    if (!has_bit(context.blocks_inside, k)) continue;
    const BlockValues* coded = has_bit(tile.mask, k) ? &tile.blocks[m++] : nullptr;
    for (size_t i = 0; i < blocks[k].size(); ++i) {
      const int32_t kept = coded == nullptr ? 0 : (*coded)[i];
      error += int64_t{blocks[k][i] - kept} * (blocks[k][i] - kept);
    }
  }
  const auto bits = static_cast<int64_t>(write_residual_tile(tile, context).size()) * 8;
  return lambda.cost(error, bits);
}

TEST(ResidualDecision, IsNeverWorseThanNothing) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const auto blocks = draw_blocks(random, 1 << (round % 7));
    const TileContext context = context_of(round % 2 == 0 ? ~uint64_t{0} : 0x00FF00FF00FF00FF);
    const Lambda lambda{256 << (round % 9)};
    const ResidualTile tile = decide_residuals(blocks, context, {lambda, 4, 2, 2, false});
    EXPECT_EQ(tile.mask & ~context.blocks_inside, 0u);
    EXPECT_EQ(tile.blocks.size(), static_cast<size_t>(std::popcount(tile.mask)));
    EXPECT_LE(cost_of(tile, blocks, context, lambda), cost_of({}, blocks, context, lambda));
  }
}

// Returns what a decoder adds, from the fields of the record (STP-3).
BlockValues decoded(const ResidualBlockFields& fields) {
  BlockValues block(4);
  const auto levels = static_cast<int32_t>(levels_of_code(fields.values.level_code).count);
  for (size_t i = 0; i < block.size(); ++i) {
    const auto value = static_cast<int32_t>(fields.values.values[i]);
    EXPECT_LT(value, levels);
    block[i] = step_of_code(fields.step_code) * (value - (levels >> 1) + fields.bias);
  }
  return block;
}

TEST(ResidualChoice, BlocksAreWhatTheFieldsSay) {
  std::mt19937 random(5);
  const TileContext context = context_of(~uint64_t{0});
  for (int round = 0; round < 30; ++round) {
    const auto blocks = draw_blocks(random, 4 << (round % 5));
    const ResidualTile tile = decide_residuals(blocks, context, {{1 << 11}, 4, 1, 2, false});
    const ResidualFields& fields = tile.fields;
    ASSERT_EQ(fields.blocks.size(), tile.blocks.size());
    for (size_t i = 0; i < tile.blocks.size(); ++i) {
      const ResidualBlockFields& block = fields.blocks[i];
      EXPECT_GE(block.step_code, fields.step_base);
      EXPECT_LT(block.step_code, fields.step_base + (1u << fields.step_bits));
      EXPECT_GE(block.values.level_code, fields.level_base);
      EXPECT_LT(block.values.level_code, fields.level_base + (1u << fields.level_bits));
      EXPECT_TRUE(fits_signed(block.bias, fields.bias_bits));
      for (size_t k = 0; k < 16; ++k) EXPECT_EQ(decoded(block)[k], tile.blocks[i][k]);
    }
  }
}

TEST(ResidualDecision, LosslessKeepsEveryDifference) {
  std::mt19937 random(4);
  const auto blocks = draw_blocks(random, 255);
  const TileContext context = context_of(~uint64_t{0});
  const ResidualTile tile = decide_residuals(blocks, context, {{1 << 20}, 7, 2, 2, true});
  EXPECT_EQ(tile.fields.step_base, 0u);
  EXPECT_EQ(cost_of(tile, blocks, context, {0}), 0);
}

}  // namespace
}  // namespace hmlfc
