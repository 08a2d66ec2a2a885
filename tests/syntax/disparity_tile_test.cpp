// Records of disparities: read back as they were written, every truncation, each error; and which
// grid block a block looks up (MOT-5, MOT-6).
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/record_helpers.hpp"
#include "vectors/draw.hpp"

namespace hmlfc {
namespace {

using test::kRecordAt;
using test::NaiveBits;
using test::name_of;

/// What reading a disparity gives: the name of the error, or its digits.
std::string outcome(const NaiveBits& bits, const DisparityContext& context, uint32_t gx,
                    uint32_t gy) {
  const std::vector<uint8_t> bytes = bits.bytes();
  FieldCursor cursor(BitString(bytes), kRecordAt * 8, Probe{});
  const auto head = read_disparity_head(cursor, context);
  if (!head) return name_of(head.error());
  const auto value = read_disparity(cursor, *head, context, gx, gy);
  return value ? std::to_string(*value) : name_of(value.error());
}

NaiveBits record_of(int32_t least, const SequenceFields& values) {
  BitWriter writer;
  put_disparity_fields(writer, least, values);
  return NaiveBits(writer.take());
}

/// A valid record with the grid blocks of some tile.
std::vector<uint8_t> draw_record(vectors::Random& random, DisparityContext& context) {
  const uint32_t side = 4u << random.below(4);
  const uint32_t tile = 32u << random.below(3);
  context.columns = (random.within(1, tile) + side - 1) / side;
  context.rows = (random.within(1, tile) + side - 1) / side;
  vectors::FieldRules rules(vectors::Json{{"disparity_density", 100}});
  return vectors::draw_disparity_record(rules, context, random);
}

// What is read makes the same record when it is written again.
TEST(DisparityTile, RandomTilesReadBack) {
  vectors::Random random(1);
  for (int round = 0; round < 500; ++round) {
    DisparityContext context;
    const std::vector<uint8_t> bytes = draw_record(random, context);
    FieldCursor cursor(BitString(bytes), 0, Probe{});
    const DisparityHead head = read_disparity_head(cursor, context).value();
    SequenceFields values{level_code_for(head.levels.count), {}, {}};
    for (uint32_t gy = 0; gy < context.rows; ++gy) {
      for (uint32_t gx = 0; gx < context.columns; ++gx) {
        const int32_t value = read_disparity(cursor, head, context, gx, gy).value();
        values.values.push_back(static_cast<uint32_t>(value - head.min_disparity));
      }
    }
    ASSERT_EQ(record_of(head.min_disparity, values).bytes(), bytes);
  }
}

TEST(DisparityTile, EveryTruncation) {
  vectors::Random random(2);
  for (int round = 0; round < 200; ++round) {
    DisparityContext context;
    const std::vector<uint8_t> bytes = draw_record(random, context);
    for (size_t length = 0; length < bytes.size(); ++length) {
      const NaiveBits cut{std::span(bytes).first(length)};
      ASSERT_EQ(outcome(cut, context, 0, 0), "tile_overrun") << length << " of " << bytes.size();
    }
  }
}

TEST(DisparityTile, EveryCode) {
  for (unsigned code = 0; code < 32; ++code) {
    NaiveBits bits;
    bits.put_signed(-1, 13).put(code, 5).put(0, 64);
    EXPECT_EQ(outcome(bits, {1, 1}, 0, 0), code > 27 ? "bad_levels" : "-1") << code;
    const NaiveBits none = NaiveBits().put_signed(-1, 13).put(code, 5);
    if (code > 27) {
      EXPECT_EQ(outcome(none, {32, 32}, 0, 0), "bad_levels") << "before the values that lack";
    }
  }
}

// A sum past 4095 is an error of its own grid block alone.
TEST(DisparityTile, ValuesPastTheInterval) {
  for (const int least : {-4096, 0, 4094, 4095}) {
    const std::vector<uint32_t> values{0, 1, 1023};
    const NaiveBits bits = record_of(least, {27, values, {}});
    for (uint32_t gx = 0; gx < 3; ++gx) {
      const int sum = least + static_cast<int>(values[gx]);
      EXPECT_EQ(outcome(bits, {3, 1}, gx, 0), sum > 4095 ? "vector_range" : std::to_string(sum));
    }
  }
}

TEST(DisparityTile, EveryFieldIsTold) {
  const auto bytes = NaiveBits().put_signed(-100, 13).put(6, 5).put(5, 3).put(7, 3).bytes();
  test::FieldRecorder recorder;
  FieldCursor cursor(BitString(bytes), 8 * kRecordAt, Probe{&recorder, nullptr, {}});
  const DisparityContext context{2, 1};
  const DisparityHead head = read_disparity_head(cursor, context).value();
  EXPECT_EQ(read_disparity(cursor, head, context, 1, 0).value(), -93);
  EXPECT_EQ(
      recorder.text(),
      "MOT-6 min_disparity@0:13=-100\nMOT-6 disparity_code@13:5=6\nMOT-6 disparity@18:3=-93\n");
}

// The grid blocks of small planes listed with their samples: a neighbour is the listed block on
// that side, or the block itself where there is none.
TEST(GridBlock, EveryPlaceAndChoice) {
  const int moves[9][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                           {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  for (unsigned log2 = 2; log2 <= 5; ++log2) {
    const int side = 1 << log2;
    for (const int width : {1, 3, 4, 5, 31, 33, 64, 65}) {
      for (const int height : {1, 8, 40}) {
        MotionPlaneShape plane;
        plane.width = static_cast<uint32_t>(width);
        plane.height = static_cast<uint32_t>(height);
        for (int y = 0; y < height; y += 2) {
          for (int x = 0; x < width; x += 2) {
            for (unsigned choice = 1; choice <= 9; ++choice) {
              int gx = x / side + moves[choice - 1][0];
              int gy = y / side + moves[choice - 1][1];
              if (gx < 0 || gx * side >= width) gx = x / side;
              if (gy < 0 || gy * side >= height) gy = y / side;
              const GridBlock expected{static_cast<uint32_t>(gx), static_cast<uint32_t>(gy)};
              ASSERT_EQ(grid_block(static_cast<uint32_t>(x), static_cast<uint32_t>(y), choice, log2,
                                   plane),
                        expected)
                  << x << ", " << y << " of " << width << " x " << height << ", choice " << choice;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
