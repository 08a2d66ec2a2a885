// Records of motion tiles: read back as they were written, every truncation, each error (MOT-3,
// MOT-4).
#include "syntax/motion_tile.hpp"

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/naive_bise.hpp"
#include "bits/naive_bits.hpp"
#include "syntax/motion_helpers.hpp"
#include "syntax/naive_motion.hpp"
#include "syntax/naive_tile.hpp"

namespace hmlfc {
namespace {

using test::EntryModel;
using test::kRecordAt;
using test::MotionModel;
using test::MotionRules;
using test::NaiveBits;
using test::name_of;

struct Case {
  MotionContext context;
  MotionModel tile;
};

Case draw_case(std::mt19937& random) {
  Case drawn;
  MotionContext& context = drawn.context;
  context.tile_log2 = static_cast<unsigned>(test::draw(random, 5, 7));
  const int side = 1 << context.tile_log2;
  const bool border = test::draw(random, 0, 1) != 0;
  context.width = static_cast<uint32_t>(border ? test::draw(random, 1, side) : side);
  context.height = static_cast<uint32_t>(border ? test::draw(random, 1, side) : side);
  context.block_size = 2u << test::draw(random, 0, 2);
  context.two_references = test::draw(random, 0, 1) != 0;
  context.disparities = test::draw(random, 0, 1) != 0;
  context.keyed = test::draw(random, 0, 1) != 0;
  const MotionRules rules{context.two_references, context.disparities, !context.keyed,
                          context.block_size == 8 ? 1u : 0u};
  drawn.tile = test::draw_motion_tile(random, rules, context.width, context.height);
  return drawn;
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

void check_entry(const PaletteEntry& entry, const EntryModel& model) {
  ASSERT_EQ(entry.reference_set, model.reference_set);
  ASSERT_EQ(entry.choice, model.choice);
  ASSERT_EQ(entry.negative, model.negative);
  ASSERT_EQ(entry.explicit_x, model.explicit_x);
  ASSERT_EQ(entry.explicit_y, model.explicit_y);
}

TEST(MotionTile, RandomTilesReadBack) {
  std::mt19937 random(1);
  for (int round = 0; round < 800; ++round) {
    const auto [context, tile] = draw_case(random);
    const std::vector<uint8_t> bytes = test::write_motion(tile).bytes();
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const auto head = read_motion_head(cursor, context);
    ASSERT_TRUE(head.has_value()) << to_string(head.error());
    ASSERT_EQ(uint32_t{1} << head->block_log2, tile.side());
    ASSERT_EQ(head->entries, tile.palette.size());
    ASSERT_EQ(head->columns, tile.columns);
    ASSERT_EQ(head->rows, tile.rows);
    ASSERT_EQ(cursor.position(), test::write_motion(tile).size());
    for (size_t e = 0; e < tile.palette.size(); ++e) {
      ASSERT_NO_FATAL_FAILURE(check_entry(head->palette[e], tile.palette[e]));
    }
    for (uint32_t y = 0; y < context.height; ++y) {
      for (uint32_t x = 0; x < context.width; ++x) {
        const uint32_t block = y / tile.side() * tile.columns + x / tile.side();
        const auto entry = read_motion_entry(cursor, *head, context, x, y);
        ASSERT_TRUE(entry.has_value()) << to_string(entry.error());
        ASSERT_NO_FATAL_FAILURE(check_entry(*entry, tile.palette[tile.indices[block]]));
      }
    }
  }
}

// A record is there as a whole or no block of the tile is.
TEST(MotionTile, EveryTruncation) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const auto [context, tile] = draw_case(random);
    const NaiveBits bits = test::write_motion(tile);
    const std::vector<uint8_t> bytes = bits.bytes();
    for (size_t length = 0; length <= bytes.size(); ++length) {
      const NaiveBits cut{std::span(bytes).first(length)};
      const std::string expected = length * 8 >= bits.size() ? "ok" : "tile_overrun";
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
  MotionModel tile;
  tile.motion_block = 1;
  tile.palette.assign(7, EntryModel{});
  tile.columns = tile.rows = 4;
  tile.indices.assign(16, 6);
  tile.indices[9] = 7;
  const NaiveBits bits = test::write_motion(tile);
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
    for (unsigned choice = 0; choice < 16; ++choice) {
      MotionContext context = whole_tile();
      context.disparities = disparities;
      MotionModel tile;
      tile.rules.disparities = disparities;
      tile.motion_block = 2;
      tile.explicit_bits = 5;
      tile.palette = {EntryModel{}, EntryModel{0, choice, false, 0, 0}};
      if (choice == 10 || choice == 11) tile.palette[1].explicit_x = -16;
      if (choice == 11) tile.palette[1].explicit_y = 15;
      tile.columns = tile.rows = 2;
      tile.indices = {0, 0, 1, 0};
      const NaiveBits bits = test::write_motion(tile);
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
        const unsigned choice = !keyed ? 0 : disparities ? 1 : 11;
        check_entry(head.palette[0], {two ? 1u : 0u, choice, false, 0, 0});
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
  test::FieldRecorder recorder("MOT-3");
  AccessCounts counts;
  FieldCursor cursor(BitString(bytes), 800, Probe{&recorder, &counts, {}});
  const auto head = read_motion_head(cursor, context);
  ASSERT_TRUE(head.has_value());
  const auto entry = read_motion_entry(cursor, *head, context, 31, 31);
  ASSERT_TRUE(entry.has_value());
  check_entry(*entry, {2, 11, false, 7, -8});
  EXPECT_EQ(recorder.text(),
            "motion_block@800:2=3 palette_size@802:3=1 explicit_bits@805:4=4 "
            "reference_set@809:3=6 choice@812:4=10 sign@816:1=1 explicit_x@817:4=-5 "
            "reference_set@821:3=2 choice@824:4=11 sign@828:1=0 explicit_x@829:4=7 "
            "explicit_y@833:4=-8 index@837:1=1 ");
  EXPECT_EQ(counts.fields, 13u);
  EXPECT_EQ(counts.steps, 0u);
}

// Whatever the bits are: an entry that may be used, or an error of this clause.
TEST(MotionTile, RandomBitsNeverDoMore) {
  std::mt19937 random(3);
  int read = 0;
  for (int round = 0; round < 5000; ++round) {
    const MotionContext context = draw_case(random).context;
    std::vector<uint8_t> bytes(static_cast<size_t>(test::draw(random, 1, 500)));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const auto head = read_motion_head(cursor, context);
    if (!head) continue;
    ASSERT_LE(head->blocks(), 1024u);
    for (int i = 0; i < 20; ++i) {
      const auto entry =
          read_motion_entry(cursor, *head, context, static_cast<uint32_t>(random()) % context.width,
                            static_cast<uint32_t>(random()) % context.height);
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
