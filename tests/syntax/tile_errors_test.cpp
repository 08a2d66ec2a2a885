// Each error of a tile record (TIL-1, TIL-4, TIL-6 to TIL-9, STP-1).
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "syntax/record_helpers.hpp"
#include "syntax/tile_cases.hpp"

namespace hmlfc {
namespace {

using test::NaiveBits;
using test::TileCase;

/// What reading block k of a record gives: the name of the error, or "ok".
std::string outcome(const NaiveBits& bits, const TileContext& context, unsigned k) {
  const std::vector<uint8_t> bytes = bits.bytes();
  FieldCursor cursor(BitString(bytes), test::kRecordAt * 8, Probe{});
  const auto head = read_tile_head(cursor, context);
  const auto entry = head ? read_block_entry(cursor, *head, context, k)
                          : Result<BlockEntry>(tl::unexpected(head.error()));
  return entry ? "ok" : test::name_of(entry.error());
}

TileContext context_of(bool predictive, int window = 16, int depth = 8) {
  TileContext context;
  context.predictive = predictive;
  context.window = window;
  context.depth = depth;
  context.block_samples = 4;
  return context;
}

// At each length, the head is there or not, and each block's values are there or not.
TEST(TileErrors, EveryTruncation) {
  vectors::Random random(1);
  for (int round = 0; round < 60; ++round) {
    TileContext context = test::draw_context(random);
    context.block_samples = 4;
    const std::vector<uint8_t> bytes = test::draw_tile_case(random, context).record();
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const TileHead head = read_tile_head(cursor, context).value();
    const bool residuals = head.residual_mask != 0;
    const uint64_t head_end = residuals ? head.residuals.values_at : head.residuals_begin;
    for (unsigned k = 0; k < 64; ++k) {
      const BlockEntry entry = read_block_entry(cursor, head, context, k).value();
      const uint64_t end =
          entry.has_residual() ? entry.values_at + bise_bits(entry.levels, 4) : head_end;
      for (size_t length = 0; length <= bytes.size(); ++length) {
        const NaiveBits cut{std::span(bytes).first(length)};
        ASSERT_EQ(outcome(cut, context, k), length * 8 >= end ? "ok" : "tile_overrun")
            << "block " << k << " in " << length << " of " << bytes.size() << " bytes";
      }
    }
  }
}

TEST(TileErrors, MaskOutside) {
  const PlaneShape narrow{0, 0, 5, 3, 1, 1, 0};  // 5 x 3 blocks
  TileContext context = context_of(true);
  context.blocks_inside = blocks_inside(narrow, 0, 0);
  for (unsigned k = 0; k < 64; ++k) {
    const uint64_t mask = uint64_t{1} << k;
    const bool inside = block_column(k) < 5 && block_row(k) < 3;
    const std::string expected = inside ? "ok" : "mask_outside";
    const NaiveBits enough = NaiveBits().put(0, 64).put(0, 64).put(0, 64);
    // motion_mode 2, residual_mode 0.
    EXPECT_EQ(outcome(NaiveBits().put(2, 2).put(0, 2).put(mask, 64).put(enough), context, k),
              expected);
    // motion_mode 0, residual_mode 2.
    EXPECT_EQ(outcome(NaiveBits().put(0, 2).put(2, 2).put(mask, 64).put(enough), context, k),
              expected);
    // residual_mode 3: one quad.
    NaiveBits quads;
    quads.put(0, 2).put(3, 2).put(1u << (k / 4), 16).put(1u << (k % 4), 4).put(enough);
    EXPECT_EQ(outcome(quads, context, k), expected);
  }
  EXPECT_EQ(outcome(NaiveBits().put(1, 2).put(1, 2).put(0, 64).put(0, 64), context, 0), "ok")
      << "mode 1 takes what is inside";
}

// motion_mode 1 of a whole tile, then sign_mode, min_x, codes_x, min_y, codes_y of window 16: 2, 6,
// 4, 6, 4 bits.
NaiveBits vectors(unsigned sign_mode, unsigned x, unsigned code_x, unsigned y, unsigned code_y) {
  NaiveBits bits;
  bits.put(1, 2).put(0, 2).put(sign_mode, 2);
  bits.put(x, 6).put(code_x, 4).put(y, 6).put(code_y, 4);
  for (int i = 0; i < 20; ++i) bits.put(0, 64);
  return bits;
}

TEST(TileErrors, SignModes) {
  for (unsigned mode = 0; mode < 4; ++mode) {
    EXPECT_EQ(outcome(vectors(mode, 16, 0, 16, 0), context_of(true), 0),
              mode == 3 ? "bad_mode" : "ok");
  }
}

TEST(TileErrors, VectorFields) {
  const TileContext context = context_of(true);
  for (unsigned f = 0; f < 64; ++f) {
    const std::string expected = f > 32 ? "vector_range" : "ok";
    EXPECT_EQ(outcome(vectors(0, f, 0, 16, 0), context, 0), expected) << f;
    EXPECT_EQ(outcome(vectors(0, 16, 0, f, 0), context, 0), expected) << f;
  }
  for (unsigned code = 0; code < 16; ++code) {
    // K = 13: 40 levels are the least that reach 33.
    const std::string expected = code > 13 ? "bad_levels" : "ok";
    EXPECT_EQ(outcome(vectors(0, 16, code, 16, 0), context, 0), expected) << code;
    EXPECT_EQ(outcome(vectors(0, 16, 0, 16, code), context, 0), expected) << code;
  }
  // Checks are made field by field.
  EXPECT_EQ(outcome(vectors(3, 33, 15, 33, 15), context, 0), "bad_mode");
  EXPECT_EQ(outcome(vectors(0, 33, 15, 16, 0), context, 0), "vector_range");
  EXPECT_EQ(outcome(vectors(0, 16, 15, 33, 0), context, 0), "bad_levels");
}

// A component beyond the window is an error of its own block alone (TIL-7).
TEST(TileErrors, VectorOutsideTheWindow) {
  for (const uint32_t sign_mode : {0u, 1u}) {
    for (const bool in_x : {false, true}) {
      TileCase made{context_of(true), {}};
      made.tile.motion_mode = 2;
      for (const unsigned k : {3u, 9u, 40u}) made.tile.motion_mask |= uint64_t{1} << k;
      VectorFields& vectors = made.tile.vectors;
      vectors.sign_mode = sign_mode;
      vectors.min_x = vectors.min_y = 10;
      vectors.x = vectors.y = {6, {6, 6, 6}, {}};  // 8 levels: up to 17
      (in_x ? vectors.x : vectors.y).values[1] = 7;
      const NaiveBits bits(made.record());
      for (unsigned k = 0; k < 64; ++k) {
        EXPECT_EQ(outcome(bits, made.context, k), k == 9 ? "vector_range" : "ok") << k;
      }
    }
  }
}

// residual_mode 1 in a reference image: level_base, level_bits, bias_bits, then zeros.
NaiveBits residuals(unsigned base, unsigned level_bits, unsigned bias_bits) {
  NaiveBits bits;
  bits.put(1, 2).put(base, 6).put(level_bits, 3).put(bias_bits, 4);
  for (int i = 0; i < 1000; ++i) bits.put(0, 64);
  return bits;
}

TEST(TileErrors, ResidualFields) {
  for (int depth = 8; depth <= 12; ++depth) {
    const TileContext context = context_of(false, 16, depth);
    for (unsigned bits = 0; bits < 8; ++bits) {
      EXPECT_EQ(outcome(residuals(0, bits, 0), context, 0), bits > 6 ? "bad_mode" : "ok") << bits;
    }
    for (unsigned bits = 0; bits < 16; ++bits) {
      EXPECT_EQ(outcome(residuals(0, 0, bits), context, 0),
                bits > static_cast<unsigned>(depth) + 2 ? "bad_mode" : "ok")
          << bits;
    }
    for (unsigned base = 0; base < 64; ++base) {
      EXPECT_EQ(outcome(residuals(base, 0, 0), context, 0),
                base > static_cast<unsigned>(3 * depth) + 3 ? "bad_levels" : "ok")
          << base;
    }
  }
}

// Blocks 5, 6, 20, 33 and 63 have a residual, with `level` and `step` above the tile's base but
// block 20, whose level and step are one more.
TileCase codes_at_the_end(unsigned level_base, unsigned level, unsigned step_base, unsigned step,
                          bool steps) {
  TileCase made{context_of(true), {}};
  made.context.steps = steps;
  made.tile.residual_mode = 2;
  made.tile.residuals = {level_base, 2, 3, step_base, steps ? 2u : 0u, {}};
  for (const unsigned k : {5u, 6u, 20u, 33u, 63u}) {
    made.tile.residual_mask |= uint64_t{1} << k;
    const unsigned more = k == 20 ? 1 : 0;
    made.tile.residuals.blocks.push_back(
        {steps ? step + more : 0, 0, {steps ? level : level + more, {0, 0, 0, 0}, {}}});
  }
  return made;
}

// A code beyond the last one spoils its block and those after it, not those before (TIL-8, STP-1).
TEST(TileErrors, CodesBeyondTheLast) {
  const TileCase of_levels = codes_at_the_end(26, 27, 0, 0, false);
  for (const TileCase& made : {of_levels, codes_at_the_end(0, 0, 14, 15, true)}) {
    for (unsigned k = 0; k < 64; ++k) {
      const bool spoilt = has_bit(made.tile.residual_mask, k) && k >= 20;
      EXPECT_EQ(outcome(NaiveBits(made.record()), made.context, k), spoilt ? "bad_levels" : "ok")
          << k;
    }
  }
  TileContext deeper = of_levels.context;
  deeper.depth = 9;
  for (unsigned k = 0; k < 64; ++k) {
    EXPECT_EQ(outcome(NaiveBits(of_levels.record()), deeper, k), "ok") << k;
  }
}

// Step fields are there with residual_step alone, after the checks of bias_bits (STP-1).
TEST(TileErrors, StepFields) {
  TileContext context = context_of(false);
  context.steps = true;
  for (unsigned base = 0; base < 16; ++base) {
    for (unsigned step_bits = 0; step_bits < 4; ++step_bits) {
      NaiveBits bits;
      bits.put(1, 2).put(3, 6).put(0, 3).put(0, 4).put(base, 4).put(step_bits, 2);
      for (unsigned block = 0; block < 64; ++block) {
        bits.put(block % (1u << step_bits), step_bits);
      }
      for (int i = 0; i < 20; ++i) bits.put(0, 64 * 4 / 20 + 1);
      bits.put(0, 64).put(0, 64).put(0, 64).put(0, 64);
      bool spoilt = false;
      for (unsigned k = 0; k < 64; ++k) {
        spoilt = spoilt || base + k % (1u << step_bits) > 15;
        ASSERT_EQ(outcome(bits, context, k), spoilt ? "bad_levels" : "ok")
            << "base " << base << ", " << step_bits << " bits, block " << k;
      }
    }
  }
  const NaiveBits bad_bias = NaiveBits().put(1, 2).put(0, 6).put(0, 3).put(11, 4);
  EXPECT_EQ(outcome(bad_bias, context, 0), "bad_mode") << "before the step fields that lack";
}

// Whatever the bits are, each block gives its entry or an error of this section.
TEST(TileErrors, RandomBitsNeverDoMore) {
  vectors::Random random(2);
  for (int round = 0; round < 3000; ++round) {
    const TileContext context = test::draw_context(random);
    std::vector<uint8_t> bytes(random.within(1, 120));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const auto head = read_tile_head(cursor, context);
    if (!head) continue;
    for (unsigned k = 0; k < 64; ++k) {
      const auto entry = read_block_entry(cursor, *head, context, k);
      if (!entry) continue;
      ASSERT_LE(std::abs(entry->dx), context.window);
      ASSERT_LE(std::abs(entry->dy), context.window);
      ASSERT_LE(entry->levels.count, 4u << context.depth);
      ASSERT_LE(std::abs(2 * entry->bias + 1), 4 << context.depth);
      ASSERT_GE(entry->step, 1);
      ASSERT_LE(entry->step, context.steps ? 256 : 1);
    }
  }
}

}  // namespace
}  // namespace hmlfc
