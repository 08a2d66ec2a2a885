// Valid tile records read back as they were written (TIL-1 to TIL-10, STP-1).
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"
#include "syntax/naive_tile.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

using test::BlockModel;
using test::TileModel;
using test::TileRecord;

// STP-2.
constexpr int32_t kSteps[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256};

void check_head(const TileHead& head, const TileModel& tile, const TileRecord& record) {
  ASSERT_EQ(head.motion_mask, tile.motion_mask());
  ASSERT_EQ(head.residual_mask, tile.residual_mask());
  ASSERT_EQ(head.vectors_begin, record.vectors_begin);
  ASSERT_EQ(head.residuals_begin, record.residuals_begin);
  if (head.motion_mask != 0) {
    ASSERT_EQ(head.vectors.sign_mode, tile.sign_mode);
    ASSERT_EQ(head.vectors.min_x, tile.min_x);
    ASSERT_EQ(head.vectors.min_y, tile.min_y);
    ASSERT_EQ(head.vectors.levels_x, levels_of_code(tile.codes_x));
    ASSERT_EQ(head.vectors.levels_y, levels_of_code(tile.codes_y));
  }
  if (head.residual_mask != 0) {
    ASSERT_EQ(head.residuals.level_base, tile.level_base);
    ASSERT_EQ(head.residuals.level_bits, tile.level_bits);
    ASSERT_EQ(head.residuals.bias_bits, tile.bias_bits);
    ASSERT_EQ(head.residuals.step_base, tile.step_base);
    ASSERT_EQ(head.residuals.step_bits, tile.step_bits);
    ASSERT_EQ(head.residuals.values_at, record.head_end);
  }
}

BlockState state_of(const BlockModel& block) {
  if (block.motion && block.residual) return BlockState::kMotionResidual;
  if (block.motion) return BlockState::kMotion;
  if (block.residual) return BlockState::kResidual;
  return BlockState::kZero;
}

void check_block(const BlockEntry& entry, const BlockModel& block, const BitString& bits) {
  ASSERT_EQ(entry.state, state_of(block));
  ASSERT_EQ(entry.has_motion(), block.motion);
  ASSERT_EQ(entry.has_residual(), block.residual);
  if (block.motion) {
    ASSERT_EQ(entry.negative, block.negative);
    ASSERT_EQ(entry.dx, block.dx);
    ASSERT_EQ(entry.dy, block.dy);
  }
  if (block.residual) {
    ASSERT_EQ(entry.levels, levels_of_code(block.level_code));
    ASSERT_EQ(entry.bias, block.bias);
    ASSERT_EQ(entry.step, kSteps[block.step_code]);
    for (size_t i = 0; i < block.values.size(); ++i) {
      ASSERT_EQ(bise_value(bits, entry.values_at, entry.levels, block.values.size(), i),
                block.values[i]);
    }
  }
}

void check_tile(const TileModel& tile) {
  const TileRecord record = test::write_tile(tile);
  const std::vector<uint8_t> bytes = record.bits.bytes();
  FieldCursor cursor(BitString(bytes), 0, Probe{});
  const auto head = read_tile_head(cursor, tile.context);
  ASSERT_TRUE(head.has_value()) << to_string(head.error());
  ASSERT_NO_FATAL_FAILURE(check_head(*head, tile, record));
  for (unsigned k = 0; k < 64; ++k) {
    const auto entry = read_block_entry(cursor, *head, tile.context, k);
    ASSERT_TRUE(entry.has_value()) << k << " " << to_string(entry.error());
    ASSERT_NO_FATAL_FAILURE(check_block(*entry, tile.blocks[k], BitString(bytes))) << k;
  }
}

TEST(Tile, RandomTilesReadBack) {
  std::mt19937 random(1);
  for (int round = 0; round < 1500; ++round) {
    const TileContext context = test::draw_context(random);
    ASSERT_NO_FATAL_FAILURE(check_tile(test::draw_tile(random, context))) << "round " << round;
  }
}

// Every window with the full range of vectors, both signs.
TEST(Tile, EveryWindow) {
  std::mt19937 random(2);
  for (int window = 0; window <= 127; ++window) {
    TileContext context;
    context.predictive = true;
    context.window = window;
    TileModel tile;
    tile.context = context;
    tile.motion_mode = 1;
    tile.sign_mode = 2;
    tile.min_x = tile.min_y = -window;
    tile.codes_x = tile.codes_y = vector_widths(window).max_code;
    for (size_t k = 0; k < 64; ++k) {
      BlockModel& block = tile.blocks[k];
      block = {true,
               k % 3 == 0,
               test::draw(random, -window, window),
               k % 2 != 0 ? window : -window,
               false,
               0,
               0,
               {}};
    }
    ASSERT_NO_FATAL_FAILURE(check_tile(tile)) << window;
  }
}

// A zero mask in modes 2 and 3 is allowed and ends the record early (TIL-4).
TEST(Tile, ZeroMasksInEveryMode) {
  for (const bool predictive : {false, true}) {
    for (const unsigned motion_mode : {0u, 2u, 3u}) {
      for (const unsigned residual_mode : {0u, 2u, 3u}) {
        TileModel tile;
        tile.context.predictive = predictive;
        tile.motion_mode = motion_mode;
        tile.residual_mode = residual_mode;
        ASSERT_NO_FATAL_FAILURE(check_tile(tile));
      }
    }
  }
}

// Bits after the last field have no meaning (TIL-1).
TEST(Tile, BitsBehindTheLastFieldDoNotMatter) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const TileModel tile = test::draw_tile(random, test::draw_context(random));
    TileRecord record = test::write_tile(tile);
    record.bits.put(~uint64_t{0}, 64);
    const std::vector<uint8_t> bytes = record.bits.bytes();
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const auto head = read_tile_head(cursor, tile.context);
    ASSERT_TRUE(head.has_value());
    for (unsigned k = 0; k < 64; ++k) {
      const auto entry = read_block_entry(cursor, *head, tile.context, k);
      ASSERT_TRUE(entry.has_value());
      ASSERT_NO_FATAL_FAILURE(check_block(*entry, tile.blocks[k], BitString(bytes)));
    }
  }
}

}  // namespace
}  // namespace hmlfc
