// The fast reader of whole tiles against one walk for each block, on sound and on damaged records.
#include "decoder/fast/tile_blocks.hpp"

#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "bits/bit_string.hpp"
#include "decoder/golden/block_walk.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "vectors/draw.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

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

/// A record of the tile that holds `site`: sound, or with one thing wrong.
Bytes draw_record(std::mt19937& random, const StreamView& stream, const BlockSite& site,
                  bool sound) {
  TileContext context = tile_context(stream, site);
  // Level codes and biases that a lower depth does not allow.
  if (!sound) context.depth = 12;
  vectors::FieldRules rules(vectors::Json{{"density", 100}});
  vectors::Random numbers(random());
  Bytes bytes = write_tile_fields(*vectors::draw_tile(rules, context, numbers), context);
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
bool compare_tile(const StreamView& stream, const BlockSite& first) {
  TileBlocks blocks;
  const bool read = read_tile_blocks(stream, first, ~uint64_t{0}, blocks).has_value();
  bool each_reads = true;
  for (unsigned k = 0; k < kBlocksInTile; ++k) {
    BlockSite site = first;
    site.bx += block_column(k);
    site.by += block_row(k);
    const PlaneShape& plane = stream.geometry.plane(site.plane);
    if (site.bx >= plane.blocks_x || site.by >= plane.blocks_y) continue;
    const auto block = walk_to_block(stream, Probe{nullptr, nullptr, site});
    each_reads = each_reads && block.has_value();
    if (read && block) expect_same_block(blocks, *block, k);
  }
  EXPECT_EQ(read, each_reads);
  return read;
}

/// The first block of each tile of level 0.
std::vector<BlockSite> tiles_of_level_0(const StreamHeader& header, const Geometry& geometry) {
  std::vector<BlockSite> sites;
  for (uint32_t view = 0; view < header.rows * header.cols; ++view) {
    for (const Plane plane : kPlanes) {
      for (uint32_t by = 0; by < geometry.plane(plane).blocks_y; by += 8) {
        for (uint32_t bx = 0; bx < geometry.plane(plane).blocks_x; bx += 8) {
          sites.push_back({0, view / header.cols, view % header.cols, plane, bx, by});
        }
      }
    }
  }
  return sites;
}

/// Tiles of level 0 that read, of `rounds` streams.
int compare_tiles(std::mt19937& random, int rounds, bool sound, int& all) {
  int reading = 0;
  for (int round = 0; round < rounds && !testing::Test::HasFailure(); ++round) {
    test::StreamParts parts(draw_header(random));
    const StreamView empty{{}, parts.header, parts.geometry};
    const auto sites = tiles_of_level_0(parts.header, parts.geometry);
    for (const BlockSite& site : sites) {
      parts.tile(0, {site.image_row, site.image_col}, site.plane, site.bx / 8, site.by / 8) =
          draw_record(random, empty, site, sound);
    }
    const Bytes file = parts.file();
    const StreamView stream{file, parse_header(file).value(), parts.geometry};
    for (const BlockSite& site : sites) reading += compare_tile(stream, site) ? 1 : 0;
    all += static_cast<int>(sites.size());
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
  test::StreamParts parts(drawn);
  TileContext context;
  context.steps = true;
  for (unsigned base = 0; base < 16; ++base) {
    for (unsigned delta = 0; delta < 4; ++delta) {
      const SequenceFields zeros{0, std::vector<uint32_t>(16), {}};
      TileFields tile;
      tile.residual_mode = 2;
      tile.residual_mask = 0b1010;
      tile.residuals = {0, 0, 0, base, 2, {{base, 0, zeros}, {base + delta, 0, zeros}}};
      parts.tile(0, {0, 0}, Plane::kY) = write_tile_fields(tile, context);
      const Bytes file = parts.file();
      const StreamView stream{file, parse_header(file).value(), parts.geometry};
      EXPECT_EQ(compare_tile(stream, {}), base + delta <= 15) << base << " + " << delta;
    }
  }
}

}  // namespace
}  // namespace hmlfc
