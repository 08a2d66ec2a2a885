// Tile records read back as they were written, and up to where they are cut (TIL-1 to TIL-10,
// STP-1). The errors of their fields are vectors.
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "syntax/tile_record.hpp"
#include "vectors/draw.hpp"

namespace hmlfc {
namespace {

/// A tile and what its place in the tree says about its record.
struct TileCase {
  TileContext context;
  TileFields tile;

  std::vector<uint8_t> record() const { return write_tile_fields(tile, context); }
};

/// A random context with a random set of blocks inside, that of some border tile.
TileContext draw_tile_context(vectors::Random& random) {
  TileContext context;
  context.predictive = random.below(4) != 0;
  PlaneShape plane;
  const bool whole = random.below(2) == 0;
  plane.blocks_x = whole ? 8 : random.within(1, 8);
  plane.blocks_y = whole ? 8 : random.within(1, 8);
  context.blocks_inside = blocks_inside(plane, 0, 0);
  context.window = static_cast<int>(random.below(random.below(2) == 0 ? 128 : 4));
  context.depth = static_cast<int>(random.within(8, 12));
  context.block_samples = uint64_t{4} << (2 * random.below(3));
  context.steps = random.below(2) == 0;
  return context;
}

/// A valid tile of random content that is not empty.
TileCase draw_tile_case(vectors::Random& random, const TileContext& context) {
  vectors::FieldRules rules;
  for (;;) {
    if (auto tile = vectors::draw_tile(rules, context, random)) return {context, *tile};
  }
}

void read_vectors(const TileHead& head, VectorFields& vectors) {
  vectors.sign_mode = head.vectors.sign_mode;
  vectors.min_x = head.vectors.min_x;
  vectors.min_y = head.vectors.min_y;
  vectors.x.level_code = level_code_for(head.vectors.levels_x.count);
  vectors.y.level_code = level_code_for(head.vectors.levels_y.count);
}

ResidualBlockFields block_of(const BlockEntry& entry, const BitString& bits, uint64_t samples) {
  ResidualBlockFields block;
  while (step_of_code(block.step_code) != entry.step) ++block.step_code;
  block.bias = entry.bias;
  block.values.level_code = level_code_for(entry.levels.count);
  for (uint64_t i = 0; i < samples; ++i) {
    block.values.values.push_back(bise_value(bits, entry.values_at, entry.levels, samples, i));
  }
  return block;
}

/// The fields that the reader finds, one block after another.
TileFields read_tile(const BitString& bits, const TileContext& context) {
  FieldCursor cursor(bits, 0, Probe{});
  const TileHead head = read_tile_head(cursor, context).value();
  TileFields tile;
  tile.motion_mode = context.predictive ? bits.field(0, 2) : 0;
  tile.residual_mode = bits.field(context.predictive ? 2 : 0, 2);
  tile.motion_mask = head.motion_mask;
  tile.residual_mask = head.residual_mask;
  read_vectors(head, tile.vectors);
  const TileResiduals& r = head.residuals;
  tile.residuals = {r.level_base, r.level_bits, r.bias_bits, r.step_base, r.step_bits, {}};
  for (unsigned k = 0; k < 64; ++k) {
    const BlockEntry entry = read_block_entry(cursor, head, context, k).value();
    EXPECT_EQ(entry.has_motion(), has_bit(head.motion_mask, k));
    EXPECT_EQ(entry.has_residual(), has_bit(head.residual_mask, k));
    if (entry.has_motion()) {
      tile.vectors.negative.push_back(entry.negative);
      tile.vectors.x.values.push_back(static_cast<uint32_t>(entry.dx - tile.vectors.min_x));
      tile.vectors.y.values.push_back(static_cast<uint32_t>(entry.dy - tile.vectors.min_y));
    }
    if (!entry.has_residual()) continue;
    tile.residuals.blocks.push_back(block_of(entry, bits, context.block_samples));
  }
  return tile;
}

// What is read makes the same record when it is written again.
void check_tile(const TileCase& drawn) {
  const std::vector<uint8_t> record = drawn.record();
  std::vector<uint8_t> longer = record;
  longer.insert(longer.end(), 8, 0xFF);  // bits after the last field have no meaning (TIL-1)
  for (const auto& bytes : {record, longer}) {
    const TileFields tile = read_tile(BitString(bytes), drawn.context);
    ASSERT_EQ(tile.motion_mask, drawn.tile.motion_mask);
    ASSERT_EQ(tile.residual_mask, drawn.tile.residual_mask);
    ASSERT_EQ(write_tile_fields(tile, drawn.context), record);
    if (tile.vectors.sign_mode == kSignsMixed) continue;
    for (const bool negative : tile.vectors.negative) {
      ASSERT_EQ(negative, tile.vectors.sign_mode == kSignsMinus);
    }
  }
}

TEST(Tile, RandomTilesReadBack) {
  vectors::Random random(1);
  for (int round = 0; round < 1500; ++round) {
    const TileContext context = draw_tile_context(random);
    ASSERT_NO_FATAL_FAILURE(check_tile(draw_tile_case(random, context))) << round;
  }
}

// Every window with the full range of vectors, both signs.
TEST(Tile, EveryWindow) {
  vectors::Random random(2);
  for (int window = 0; window <= 127; ++window) {
    TileCase made;
    made.context.predictive = true;
    made.context.window = window;
    made.tile.motion_mode = 1;
    made.tile.motion_mask = ~uint64_t{0};
    VectorFields& vectors = made.tile.vectors;
    vectors.sign_mode = kSignsMixed;
    vectors.min_x = vectors.min_y = -window;
    vectors.x.level_code = vectors.y.level_code = vector_widths(window).max_code;
    const auto widest = 2 * static_cast<uint32_t>(window);
    for (uint32_t k = 0; k < 64; ++k) {
      vectors.negative.push_back(k % 3 == 0);
      vectors.x.values.push_back(random.within(0, widest));
      vectors.y.values.push_back(k % 2 != 0 ? widest : 0);
    }
    ASSERT_NO_FATAL_FAILURE(check_tile(made)) << window;
  }
}

// A zero mask in modes 2 and 3 is allowed and ends the record early (TIL-4).
TEST(Tile, ZeroMasksInEveryMode) {
  for (const bool predictive : {false, true}) {
    for (const uint32_t motion_mode : {0u, 2u, 3u}) {
      for (const uint32_t residual_mode : {0u, 2u, 3u}) {
        TileCase made;
        made.context.predictive = predictive;
        made.tile.motion_mode = motion_mode;
        made.tile.residual_mode = residual_mode;
        ASSERT_NO_FATAL_FAILURE(check_tile(made));
      }
    }
  }
}

// At each length, the head is there or not, and each block's values are there or not.
TEST(Tile, EveryTruncation) {
  vectors::Random random(1);
  for (int round = 0; round < 60; ++round) {
    TileContext context = draw_tile_context(random);
    context.block_samples = 4;
    const std::vector<uint8_t> bytes = draw_tile_case(random, context).record();
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const TileHead head = read_tile_head(cursor, context).value();
    const bool residuals = head.residual_mask != 0;
    const uint64_t head_end = residuals ? head.residuals.values_at : head.residuals_begin;
    for (unsigned k = 0; k < 64; ++k) {
      const BlockEntry entry = read_block_entry(cursor, head, context, k).value();
      const uint64_t end =
          entry.has_residual() ? entry.values_at + bise_bits(entry.levels, 4) : head_end;
      for (size_t length = 0; length <= bytes.size(); ++length) {
        const BitString part{std::span(bytes).first(length)};
        FieldCursor cut(part, 0, Probe{});
        const auto cut_head = read_tile_head(cut, context);
        const auto found = cut_head ? read_block_entry(cut, *cut_head, context, k)
                                    : Result<BlockEntry>(tl::unexpected(cut_head.error()));
        ASSERT_EQ(found.has_value(), length * 8 >= end)
            << "block " << k << " in " << length << " of " << bytes.size() << " bytes";
        if (!found) {
          ASSERT_EQ(found.error().code, ErrorCode::kTileOverrun);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
