// Records of motion tiles: read back as they were written, every truncation, each error (MOT-3,
// MOT-4).
#include "syntax/motion_tile.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "syntax/record_helpers.hpp"
#include "vectors/draw.hpp"

namespace hmlfc {
namespace {

using test::kRecordAt;
using test::NaiveBits;
using test::name_of;

MotionContext draw_context(vectors::Random& random) {
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
std::vector<uint8_t> draw_record(vectors::Random& random, const MotionContext& context) {
  vectors::FieldRules rules(vectors::Json{{"motion_density", 100}});
  return vectors::draw_motion_record(rules, context, random);
}

NaiveBits record_of(const MotionTileFields& tile, const MotionContext& context) {
  BitWriter writer;
  put_motion_fields(writer, tile, {context.two_references, !context.keyed});
  return NaiveBits(writer.take());
}

/// What reading the entry of sample (x, y) gives: the name of the error, or "ok".
std::string outcome(const NaiveBits& bits, const MotionContext& context, uint32_t x = 0,
                    uint32_t y = 0) {
  const std::vector<uint8_t> bytes = bits.bytes();
  FieldCursor cursor(BitString(bytes), kRecordAt * 8, Probe{});
  const auto head = read_motion_head(cursor, context);
  if (!head) return name_of(head.error());
  const auto entry = read_motion_entry(cursor, *head, context, x, y);
  return entry ? "ok" : name_of(entry.error());
}

// What is read makes the same record when it is written again.
TEST(MotionTile, RandomTilesReadBack) {
  vectors::Random random(1);
  for (int round = 0; round < 800; ++round) {
    const MotionContext context = draw_context(random);
    const std::vector<uint8_t> bytes = draw_record(random, context);
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
    ASSERT_EQ(record_of(tile, context).bytes(), bytes);
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

// A record is there as a whole or no block of the tile is.
TEST(MotionTile, EveryTruncation) {
  vectors::Random random(2);
  for (int round = 0; round < 200; ++round) {
    const MotionContext context = draw_context(random);
    const std::vector<uint8_t> bytes = draw_record(random, context);
    for (size_t length = 0; length <= bytes.size(); ++length) {
      const NaiveBits cut{std::span(bytes).first(length)};
      const std::string expected = length == bytes.size() ? "ok" : "tile_overrun";
      ASSERT_EQ(outcome(cut, context), expected) << length << " of " << bytes.size();
      ASSERT_EQ(outcome(cut, context, context.width - 1, context.height - 1), expected);
    }
  }
}

MotionContext whole_tile() {
  MotionContext context;
  context.width = context.height = 32;
  context.keyed = true;
  context.block_size = 2;
  return context;
}

NaiveBits head_fields(unsigned motion_block, unsigned palette_size, unsigned explicit_bits) {
  NaiveBits bits;
  bits.put(motion_block, 2).put(palette_size, 3).put(explicit_bits, 4);
  for (int i = 0; i < 20; ++i) bits.put(0, 64);
  return bits;
}

TEST(MotionTile, HeadFields) {
  for (unsigned block = 0; block < 4; ++block) {
    for (unsigned bits = 0; bits < 16; ++bits) {
      for (const unsigned block_size : {2u, 4u, 8u}) {
        MotionContext context = whole_tile();
        context.block_size = block_size;
        const bool valid = bits <= 12 && (4u << block) >= block_size;
        EXPECT_EQ(outcome(head_fields(block, 0, bits), context), valid ? "ok" : "bad_mode");
      }
    }
  }
  EXPECT_EQ(outcome(NaiveBits().put(0, 8), whole_tile()), "tile_overrun");
  MotionContext large = whole_tile();
  large.block_size = 8;
  const std::vector<uint8_t> head = head_fields(0, 7, 15).bytes();
  EXPECT_EQ(outcome(NaiveBits(std::span(head).first(2)), large), "bad_mode")
      << "before the entries that lack";
}

// Seven entries take indices of 8 levels: index 7 is for no block, and an error of its own alone.
TEST(MotionTile, IndexBeyondThePalette) {
  MotionTileFields tile;
  tile.block_log2 = 3;
  tile.palette.assign(7, {});
  tile.indices = {level_code_for(7), std::vector<uint32_t>(16, 6), {}};
  tile.indices.values[9] = 7;
  const NaiveBits bits = record_of(tile, whole_tile());
  for (uint32_t y = 0; y < 32; ++y) {
    for (uint32_t x = 0; x < 32; ++x) {
      const bool spoilt = y / 8 == 2 && x / 8 == 1;
      ASSERT_EQ(outcome(bits, whole_tile(), x, y), spoilt ? "bad_mode" : "ok") << x << ", " << y;
    }
  }
}

// Each choice in an entry that one block uses and the others do not.
TEST(MotionTile, EveryChoice) {
  for (const bool disparities : {false, true}) {
    for (uint8_t choice = 0; choice < 16; ++choice) {
      MotionContext context = whole_tile();
      context.disparities = disparities;
      MotionTileFields tile;
      tile.block_log2 = 4;
      tile.explicit_bits = 5;
      tile.palette = {{}, {0, choice, false, -16, 15}};
      tile.indices = {level_code_for(2), {0, 0, 1, 0}, {}};
      const NaiveBits bits = record_of(tile, context);
      const bool valid = choice == 0 || choice == 11 || (choice < 11 && disparities);
      EXPECT_EQ(outcome(bits, context, 15, 15), "ok") << choice;
      EXPECT_EQ(outcome(bits, context, 15, 16), valid ? "ok" : "bad_mode") << choice;
      EXPECT_EQ(outcome(bits, context, 16, 31), "ok") << choice;
    }
  }
}

TEST(MotionTile, EmptyTiles) {
  for (const bool two : {false, true}) {
    for (const bool disparities : {false, true}) {
      for (const bool keyed : {false, true}) {
        MotionContext context = whole_tile();
        context.tile_log2 = 6;
        context.two_references = two;
        context.disparities = disparities;
        context.keyed = keyed;
        const MotionHead head = empty_motion_head(context);
        EXPECT_EQ(head.entries, 1u);
        EXPECT_EQ(head.block_log2, 6u);
        EXPECT_EQ(head.blocks(), 1u);
        EXPECT_TRUE(is_usable(head.palette[0], context));
        const uint8_t choice = !keyed ? 0 : disparities ? 1 : 11;
        EXPECT_EQ(head.palette[0], (PaletteEntry{two, choice, false, 0, 0}));
      }
    }
  }
}

TEST(MotionTile, EveryFieldIsTold) {
  NaiveBits bits;
  bits.put(3, 2).put(1, 3).put(4, 4);                                      // one block of 32
  bits.put(6, 3).put(10, 4).put(1, 1).put_signed(-5, 4);                   // entry 0
  bits.put(2, 3).put(11, 4).put(0, 1).put_signed(7, 4).put_signed(-8, 4);  // entry 1
  bits.put(1, 1);                                                          // index
  const std::vector<uint8_t> bytes = bits.bytes();
  MotionContext context = whole_tile();
  context.two_references = context.disparities = true;
  context.keyed = false;
  test::FieldRecorder recorder;
  AccessCounts counts;
  FieldCursor cursor(BitString(bytes), 8 * kRecordAt, Probe{&recorder, &counts, {}});
  const MotionHead head = read_motion_head(cursor, context).value();
  EXPECT_EQ(read_motion_entry(cursor, head, context, 31, 31).value(),
            (PaletteEntry{2, 11, false, 7, -8}));
  EXPECT_EQ(recorder.text(),
            "MOT-3 motion_block@0:2=3\nMOT-3 palette_size@2:3=1\nMOT-3 explicit_bits@5:4=4\n"
            "MOT-3 reference_set@9:3=6\nMOT-3 choice@12:4=10\nMOT-3 sign@16:1=1\n"
            "MOT-3 explicit_x@17:4=-5\n"
            "MOT-3 reference_set@21:3=2\nMOT-3 choice@24:4=11\nMOT-3 sign@28:1=0\n"
            "MOT-3 explicit_x@29:4=7\nMOT-3 explicit_y@33:4=-8\nMOT-3 index@37:1=1\n");
  EXPECT_EQ(counts.fields, 13u);
  EXPECT_EQ(counts.steps, 0u);
}

// Whatever the bits are: an entry that may be used, or an error of this clause.
TEST(MotionTile, RandomBitsNeverDoMore) {
  vectors::Random random(3);
  int read = 0;
  for (int round = 0; round < 5000; ++round) {
    const MotionContext context = draw_context(random);
    std::vector<uint8_t> bytes(random.within(1, 500));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const auto head = read_motion_head(cursor, context);
    if (!head) continue;
    ASSERT_LE(head->blocks(), 1024u);
    for (int i = 0; i < 20; ++i) {
      const auto entry = read_motion_entry(cursor, *head, context, random.below(context.width),
                                           random.below(context.height));
      if (!entry) continue;
      ++read;
      ASSERT_LE(entry->choice, 11u);
      ASSERT_LE(entry->reference_set, context.two_references ? 7u : 0u);
      ASSERT_GE(entry->explicit_x, -2048);
      ASSERT_LE(entry->explicit_x, 2047);
    }
  }
  EXPECT_GT(read, 5000);
}

}  // namespace
}  // namespace hmlfc
