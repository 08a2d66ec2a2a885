// The fast reader of whole tiles against one walk for each block, on sound and on damaged records.
#include "decoder/fast/tile_blocks.hpp"

#include <cstdint>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "bits/bit_string.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/naive_stream.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveTile;
using test::NaiveTree;

// Two levels; in level 0 image (0, 0) is the reference of the three others.
StreamHeader draw_header(std::mt19937& random) {
  StreamHeader header;
  header.rows = header.cols = 2;
  header.width = static_cast<uint32_t>(test::draw(random, 1, 70));
  header.height = static_cast<uint32_t>(test::draw(random, 1, 70));
  header.depth = test::draw(random, 8, 12);
  header.block_log2 = static_cast<unsigned>(test::draw(random, 1, 3));
  header.window = test::draw(random, 0, 127);
  header.tree_height = 1;
  header.levels = {{2, 2}, {1, 1}};
  header.profile = Profile::kExtended;
  header.feature_flags = random() % 4;
  if (header.has(Feature::kMotionTiles)) header.motion_tile_log2 = 5;
  return header;
}

bool is_motion(const NaiveTile& tile) {
  return tile.plane == test::kMotionOfY || tile.plane == test::kMotionOfChroma;
}

/// A record for `tile`: sound, or with one thing wrong.
Bytes draw_record(std::mt19937& random, const StreamHeader& header, const NaiveTree& tree,
                  const NaiveTile& tile, bool sound) {
  TileContext context;
  context.predictive =
      tree.reference(tile.image) != tile.image && !header.has(Feature::kMotionTiles);
  context.steps = header.has(Feature::kResidualStep);
  context.window = header.window;
  // Level codes and biases that a lower depth does not allow.
  context.depth = sound ? header.depth : 12;
  context.block_samples = uint64_t{1} << (2 * header.block_log2);
  const auto blocks = tree.plane_blocks(tile.plane);
  PlaneShape shape;
  shape.blocks_x = blocks.width;
  shape.blocks_y = blocks.height;
  context.blocks_inside = blocks_inside(shape, tile.tx, tile.ty);
  Bytes bytes = test::write_tile(test::draw_tile(random, context)).bits.bytes();
  if (sound) return bytes;
  switch (random() % 3) {
    case 0:
      bytes.resize(1 + random() % bytes.size());
      break;
    case 1:
      bytes[random() % bytes.size()] ^= static_cast<uint8_t>(1u << random() % 8);
      break;
    default:
      break;
  }
  return bytes;
}

void expect_same_block(const TileBlocks& blocks, const CodedBlock& block, unsigned k) {
  ASSERT_EQ(has_bit(blocks.motion_mask, k), block.entry.has_motion());
  ASSERT_EQ(has_bit(blocks.residual_mask, k), block.entry.has_residual());
  if (block.entry.has_motion()) {
    ASSERT_EQ(blocks.dx[k], block.entry.dx);
    ASSERT_EQ(blocks.dy[k], block.entry.dy);
    ASSERT_EQ(blocks.negative[k], block.entry.negative);
  }
  if (!block.entry.has_residual()) return;
  for (size_t i = 0; i < block.residual.size(); ++i) {
    ASSERT_EQ(blocks.residual(k)[i], block.residual[i]) << "block " << k << ", value " << i;
  }
}

// The tile reads if and only if each of its blocks does.
bool compare_tile(const StreamView& stream, const NaiveTile& tile) {
  BlockSite site{0, tile.image.row, tile.image.col, tile.plane, 8 * tile.tx, 8 * tile.ty};
  TileBlocks blocks;
  const bool read = read_tile_blocks(stream, site, ~uint64_t{0}, blocks).has_value();
  bool each_reads = true;
  for (unsigned k = 0; k < kBlocksInTile; ++k) {
    site.bx = 8 * tile.tx + block_column(k);
    site.by = 8 * tile.ty + block_row(k);
    const PlaneShape& plane = stream.geometry.plane(tile.plane);
    if (site.bx >= plane.blocks_x || site.by >= plane.blocks_y) continue;
    const auto block = walk_to_block(stream, Probe{nullptr, nullptr, site});
    each_reads = each_reads && block.has_value();
    if (read && block) expect_same_block(blocks, *block, k);
  }
  EXPECT_EQ(read, each_reads);
  return read;
}

/// Tiles of level 0 that read, of `rounds` streams.
int compare_tiles(std::mt19937& random, int rounds, bool sound, int& all) {
  int reading = 0;
  for (int round = 0; round < rounds && !testing::Test::HasFailure(); ++round) {
    const StreamHeader drawn = draw_header(random);
    const NaiveTree tree(drawn);
    std::map<uint64_t, Bytes> records;
    for (const NaiveTile& tile : tree.tiles()) {
      if (tile.image.level > 0 || is_motion(tile)) continue;
      records[tree.tile_number(tile)] = draw_record(random, drawn, tree, tile, sound);
    }
    const Bytes file = test::naive_file(drawn, test::naive_index(records, tree.tiles().size()));
    const StreamHeader header = parse_header(file).value();
    const StreamView stream{file, header, Geometry(header)};
    for (const NaiveTile& tile : tree.tiles()) {
      if (tile.image.level > 0 || is_motion(tile)) continue;
      ++all;
      reading += compare_tile(stream, tile) ? 1 : 0;
    }
  }
  return reading;
}

TEST(TileBlocks, EqualsOneWalkForEachBlock) {
  std::mt19937 random(1);
  int all = 0;
  const int reading = compare_tiles(random, 12, true, all);
  EXPECT_EQ(reading, all) << "sound records";
}

TEST(TileBlocks, FailsIfAndOnlyIfABlockFails) {
  std::mt19937 random(2);
  int all = 0;
  const int reading = compare_tiles(random, 40, false, all);
  EXPECT_GT(reading, all / 10);
  EXPECT_LT(reading, all - all / 10);
}

// A step code past the last one spoils the tile, whatever its base and its delta are (STP-1).
TEST(TileBlocks, StepCodesUpToTheLast) {
  StreamHeader drawn;
  drawn.profile = Profile::kExtended;
  drawn.feature_flags = feature_bit(Feature::kResidualStep);
  drawn.rows = drawn.cols = 2;
  drawn.width = drawn.height = 8;
  drawn.tree_height = 1;
  drawn.levels = {{2, 2}, {1, 1}};
  const NaiveTree tree(drawn);
  const NaiveTile place{{0, 0, 0}, Plane::kY, 0, 0};
  for (unsigned base = 0; base < 16; ++base) {
    for (unsigned delta = 0; delta < 4; ++delta) {
      test::TileModel tile;
      tile.context.steps = true;
      tile.residual_mode = 2;
      tile.step_base = base;
      tile.step_bits = 2;
      for (const size_t k : {1u, 3u}) {
        tile.blocks[k].residual = true;
        tile.blocks[k].step_code = base + (k == 3 ? delta : 0);
        tile.blocks[k].values.assign(16, 0);
      }
      const std::map<uint64_t, Bytes> records{
          {tree.tile_number(place), test::write_tile(tile).bits.bytes()}};
      const Bytes file = test::naive_file(drawn, test::naive_index(records, tree.tiles().size()));
      const StreamHeader header = parse_header(file).value();
      const StreamView stream{file, header, Geometry(header)};
      EXPECT_EQ(compare_tile(stream, place), base + delta <= 15) << base << " + " << delta;
    }
  }
}

}  // namespace
}  // namespace hmlfc
