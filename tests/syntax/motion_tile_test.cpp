// Records of motion tiles and of disparities: read back as they were written, and not at all where
// they are cut (MOT-3, MOT-4, MOT-6). The errors of their fields are vectors.
#include "syntax/motion_tile.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vectors/draw.hpp"

namespace hmlfc {
namespace {

using Bytes = std::vector<uint8_t>;

MotionContext draw_motion_context(vectors::Random& random) {
  MotionContext context;
  context.tile_log2 = random.within(5, 7);
  const uint32_t side = 1u << context.tile_log2;
  const bool border = random.below(2) == 0;
  context.width = border ? random.within(1, side) : side;
  context.height = border ? random.within(1, side) : side;
  context.block_size = 2u << random.below(3);
  context.two_references = random.below(2) == 0;
  context.disparities = random.below(2) == 0;
  context.keyed = random.below(2) == 0;
  return context;
}

/// A valid record: any palette and indices.
Bytes draw_motion(vectors::Random& random, const MotionContext& context) {
  vectors::FieldRules rules(vectors::Json{{"motion_density", 100}});
  return vectors::draw_motion_record(rules, context, random);
}

/// A valid record with the grid blocks of some tile.
Bytes draw_disparities(vectors::Random& random, DisparityContext& context) {
  const uint32_t side = 4u << random.below(4);
  const uint32_t tile = 32u << random.below(3);
  context.columns = (random.within(1, tile) + side - 1) / side;
  context.rows = (random.within(1, tile) + side - 1) / side;
  vectors::FieldRules rules(vectors::Json{{"disparity_density", 100}});
  return vectors::draw_disparity_record(rules, context, random);
}

// What is read makes the same record when it is written again.
TEST(MotionTile, RandomTilesReadBack) {
  vectors::Random random(1);
  for (int round = 0; round < 800; ++round) {
    const MotionContext context = draw_motion_context(random);
    const Bytes bytes = draw_motion(random, context);
    const BitString bits(bytes);
    FieldCursor cursor(bits, 0, Probe{});
    const MotionHead head = read_motion_head(cursor, context).value();
    MotionTileFields tile;
    tile.block_log2 = head.block_log2;
    tile.explicit_bits = bits.field(5, 4);
    tile.palette.assign(head.palette.begin(), head.palette.begin() + head.entries);
    tile.indices.level_code = level_code_for(head.entries);
    for (uint64_t i = 0; i < head.blocks(); ++i) {
      tile.indices.values.push_back(
          bise_value(bits, head.indices_at, head.levels, head.blocks(), i));
    }
    BitWriter writer;
    put_motion_fields(writer, tile, {context.two_references, !context.keyed});
    ASSERT_EQ(writer.take(), bytes);
    const uint32_t side = 1u << head.block_log2;
    ASSERT_EQ(head.columns, (context.width + side - 1) / side);
    for (uint32_t y = 0; y < context.height; ++y) {
      for (uint32_t x = 0; x < context.width; ++x) {
        const uint32_t index = tile.indices.values[y / side * head.columns + x / side];
        ASSERT_EQ(read_motion_entry(cursor, head, context, x, y).value(), head.palette[index]);
      }
    }
  }
}

TEST(DisparityTile, RandomTilesReadBack) {
  vectors::Random random(1);
  for (int round = 0; round < 500; ++round) {
    DisparityContext context;
    const Bytes bytes = draw_disparities(random, context);
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const DisparityHead head = read_disparity_head(cursor, context).value();
    SequenceFields values{level_code_for(head.levels.count), {}, {}};
    for (uint32_t gy = 0; gy < context.rows; ++gy) {
      for (uint32_t gx = 0; gx < context.columns; ++gx) {
        const int32_t value = read_disparity(cursor, head, context, gx, gy).value();
        values.values.push_back(static_cast<uint32_t>(value - head.min_disparity));
      }
    }
    BitWriter writer;
    put_disparity_fields(writer, head.min_disparity, values);
    ASSERT_EQ(writer.take(), bytes);
  }
}

/// Checks that `read`, of the head of a record, fails with tile_overrun for each part of `bytes`.
template <class Read>
void expect_overruns(const Bytes& bytes, const Read& read) {
  for (size_t length = 0; length < bytes.size(); ++length) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    FieldCursor cursor(BitString(cut), 0, Probe{});
    const auto head = read(cursor);
    ASSERT_FALSE(head.has_value()) << length << " of " << bytes.size();
    ASSERT_EQ(head.error().code, ErrorCode::kTileOverrun) << length << " of " << bytes.size();
  }
}

// A record is there as a whole or no block of the tile is.
TEST(MotionTile, EveryTruncation) {
  vectors::Random random(2);
  for (int round = 0; round < 200; ++round) {
    const MotionContext context = draw_motion_context(random);
    expect_overruns(draw_motion(random, context),
                    [&](FieldCursor& cursor) { return read_motion_head(cursor, context); });
    DisparityContext disparities;
    const Bytes record = draw_disparities(random, disparities);
    expect_overruns(record,
                    [&](FieldCursor& cursor) { return read_disparity_head(cursor, disparities); });
  }
}

}  // namespace
}  // namespace hmlfc
