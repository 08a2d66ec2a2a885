// Records of disparities: read back as they were written, every truncation, each error; and which
// grid block a block looks up (MOT-5, MOT-6).
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "syntax/motion_helpers.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/naive_motion.hpp"
#include "syntax/naive_tile.hpp"

namespace hmlfc {
namespace {

using test::DisparityModel;
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

DisparityModel draw_tile(std::mt19937& random) {
  const uint32_t side = 4u << test::draw(random, 0, 3);
  const int tile = 32 << test::draw(random, 0, 2);
  return test::draw_disparity_tile(random, static_cast<uint32_t>(test::draw(random, 1, tile)),
                                   static_cast<uint32_t>(test::draw(random, 1, tile)), side);
}

TEST(DisparityTile, RandomTilesReadBack) {
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    const DisparityModel tile = draw_tile(random);
    const DisparityContext context{tile.columns, tile.rows};
    const NaiveBits bits = test::write_disparities(tile);
    for (uint32_t gy = 0; gy < tile.rows; ++gy) {
      for (uint32_t gx = 0; gx < tile.columns; ++gx) {
        ASSERT_EQ(outcome(bits, context, gx, gy), std::to_string(tile.at(gx, gy)));
      }
    }
  }
}

TEST(DisparityTile, EveryTruncation) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const DisparityModel tile = draw_tile(random);
    const NaiveBits bits = test::write_disparities(tile);
    const std::vector<uint8_t> bytes = bits.bytes();
    for (size_t length = 0; length <= bytes.size(); ++length) {
      const NaiveBits cut{std::span(bytes).first(length)};
      const bool whole = length * 8 >= bits.size();
      ASSERT_EQ(outcome(cut, {tile.columns, tile.rows}, 0, 0),
                whole ? std::to_string(tile.at(0, 0)) : "tile_overrun")
          << length << " of " << bytes.size();
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
    DisparityModel tile;
    tile.least = least;
    tile.code = 27;
    tile.columns = 3;
    tile.rows = 1;
    tile.values = {0, 1, 1023};
    const NaiveBits bits = test::write_disparities(tile);
    for (uint32_t gx = 0; gx < 3; ++gx) {
      const int sum = tile.at(gx, 0);
      EXPECT_EQ(outcome(bits, {3, 1}, gx, 0), sum > 4095 ? "vector_range" : std::to_string(sum));
    }
  }
}

TEST(DisparityTile, EveryFieldIsTold) {
  DisparityModel tile;
  tile.least = -100;
  tile.code = 6;  // 8 levels of 3 bits
  tile.columns = 2;
  tile.values = {5, 7};
  const std::vector<uint8_t> bytes = test::write_disparities(tile).bytes();
  test::FieldRecorder recorder("MOT-6");
  FieldCursor cursor(BitString(bytes), 80, Probe{&recorder, nullptr, {}});
  const DisparityContext context{2, 1};
  const auto head = read_disparity_head(cursor, context);
  ASSERT_TRUE(head.has_value());
  EXPECT_EQ(read_disparity(cursor, *head, context, 1, 0).value(), -93);
  EXPECT_EQ(recorder.text(), "min_disparity@80:13=-100 disparity_code@93:5=6 disparity@98:3=-93 ");
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
