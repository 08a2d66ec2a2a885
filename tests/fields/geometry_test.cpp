// Geometry against a tree in which everything is listed (STR-2 to STR-6, IDX-1 to IDX-3, DEC-1).
#include "fields/geometry.hpp"

#include <cstdint>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fields/naive_header.hpp"
#include "fields/naive_tree.hpp"

namespace hmlfc {
namespace {

using test::NaiveImage;
using test::NaiveSize;
using test::NaiveTile;
using test::NaiveTree;

StreamHeader draw_small_header() {
  StreamHeader h;
  h.rows = *rc::gen::inRange(1u, 10u);
  h.cols = *rc::gen::inRange(1u, 10u);
  h.width = *rc::gen::inRange(1u, 150u);
  h.height = *rc::gen::inRange(1u, 150u);
  h.chroma_format = *rc::gen::element(ChromaFormat::k420, ChromaFormat::k444);
  h.block_log2 = *rc::gen::inRange(1u, 4u);
  h.tree_height = *rc::gen::inRange(0, 5);
  h.cluster_rows = *rc::gen::inRange(1u, 5u);
  h.cluster_cols = *rc::gen::inRange(h.cluster_rows == 1 ? 2u : 1u, 5u);
  for (int level = 0; level <= h.tree_height; ++level) {
    h.levels.push_back({*rc::gen::inRange<uint8_t>(1, 7), *rc::gen::inRange<uint8_t>(1, 7)});
  }
  return h;
}

ImagePos pos(const NaiveImage& image) { return {image.row, image.col}; }

RC_GTEST_PROP(Geometry, LevelsAndPlanes, ()) {
  const StreamHeader header = draw_small_header();
  const Geometry geometry(header);
  const NaiveTree tree(header);
  RC_ASSERT(geometry.top() == header.tree_height);
  for (int l = 0; l <= header.tree_height; ++l) {
    RC_ASSERT(geometry.level(l).rows == tree.level_size(l).height);
    RC_ASSERT(geometry.level(l).cols == tree.level_size(l).width);
  }
  for (const Plane plane : kPlanes) {
    const PlaneShape& shape = geometry.plane(plane);
    const NaiveSize size = tree.plane_size(plane);
    const NaiveSize blocks = tree.plane_blocks(plane);
    const NaiveSize tiles = tree.plane_tiles(plane);
    RC_ASSERT(shape.width == size.width && shape.height == size.height);
    RC_ASSERT(shape.blocks_x == blocks.width && shape.blocks_y == blocks.height);
    RC_ASSERT(shape.tiles_x == tiles.width && shape.tiles_y == tiles.height);
  }
}

RC_GTEST_PROP(Geometry, ImageNumbersCountBreadthFirst, ()) {
  const StreamHeader header = draw_small_header();
  const Geometry geometry(header);
  const NaiveTree tree(header);
  RC_ASSERT(geometry.image_count() == tree.images().size());
  for (uint64_t number = 0; number < tree.images().size(); ++number) {
    const NaiveImage& image = tree.images()[number];
    RC_ASSERT(geometry.image_number(image.level, pos(image)) == number);
  }
}

// Tile numbers are 0, 1, 2, ... over all tiles: a bijection.
RC_GTEST_PROP(Geometry, TileNumbersCountAllTiles, ()) {
  const StreamHeader header = draw_small_header();
  const Geometry geometry(header);
  const NaiveTree tree(header);
  const uint64_t count = tree.tiles().size();
  RC_ASSERT(geometry.tile_count() == count);
  for (uint64_t number = 0; number < count; ++number) {
    const NaiveTile& tile = tree.tiles()[number];
    const uint64_t image = geometry.image_number(tile.image.level, pos(tile.image));
    RC_ASSERT(geometry.tile_number(image, tile.plane, tile.tx, tile.ty) == number);
  }
  RC_ASSERT(geometry.group_count() == (count - 1) / 64 + 1);
  RC_ASSERT(geometry.root_entry_count() == (count - 1) / 4096 + 1);
}

RC_GTEST_PROP(Geometry, ReferencesAndKeys, ()) {
  const StreamHeader header = draw_small_header();
  const Geometry geometry(header);
  const NaiveTree tree(header);
  for (const NaiveImage& image : tree.images()) {
    const NaiveImage reference = tree.reference(image);
    RC_ASSERT(geometry.reference_of(image.level, pos(image)) == pos(reference));
    RC_ASSERT(geometry.is_reference(image.level, pos(image)) == (reference == image));
    const bool top = image.level == header.tree_height;
    RC_ASSERT(geometry.is_key(image.level, pos(image)) == (top && reference == image));
  }
  const auto keys = tree.keys();
  RC_ASSERT(geometry.key_count() == keys.size());
  for (uint64_t number = 0; number < keys.size(); ++number) {
    RC_ASSERT(geometry.key_number(pos(keys[number])) == number);
  }
}

// Step by step by parents, and at once by DEC-1: row / cluster_rows^l.
RC_GTEST_PROP(Geometry, Ancestors, ()) {
  const StreamHeader header = draw_small_header();
  const Geometry geometry(header);
  const NaiveTree tree(header);
  for (const NaiveImage& image : tree.images()) {
    NaiveImage ancestor = image;
    uint32_t row_power = 1;
    uint32_t col_power = 1;
    for (int l = image.level; l <= header.tree_height; ++l) {
      const ImagePos found = geometry.ancestor(pos(image), image.level, l);
      RC_ASSERT(found == pos(ancestor));
      RC_ASSERT(found.row == image.row / row_power && found.col == image.col / col_power);
      RC_ASSERT(found.row < geometry.level(l).rows && found.col < geometry.level(l).cols);
      ancestor = tree.parent(ancestor);
      row_power *= header.cluster_rows;
      col_power *= header.cluster_cols;
    }
  }
}

TEST(Geometry, BorderClustersAndGroupsByHand) {
  StreamHeader header = test::some_header(2);  // 5 x 7 views, 2 x 3 clusters
  header.levels = {{4, 4}, {2, 2}, {1, 1}};
  const Geometry geometry(header);
  EXPECT_EQ(geometry.level(1).rows, 3u);
  EXPECT_EQ(geometry.level(1).cols, 3u);
  EXPECT_EQ(geometry.level(2).rows, 2u);
  EXPECT_EQ(geometry.level(2).cols, 1u);
  EXPECT_EQ(geometry.image_count(), 2u + 9u + 35u);
  EXPECT_EQ(geometry.image_number(0, {0, 0}), 11u);
  // View (4, 6) is alone in row 4 of its 4 x 4 group and third of the columns 4, 5, 6.
  EXPECT_EQ(geometry.reference_of(0, {4, 6}), (ImagePos{4, 5}));
  // A whole group of 4: the second.
  EXPECT_EQ(geometry.reference_of(0, {3, 0}), (ImagePos{1, 1}));
  // Views (4, 6) -> (2, 2) -> (1, 0).
  EXPECT_EQ(geometry.ancestor({4, 6}, 0, 1), (ImagePos{2, 2}));
  EXPECT_EQ(geometry.ancestor({4, 6}, 0, 2), (ImagePos{1, 0}));
  EXPECT_EQ(geometry.key_count(), 2u);
}

// The largest tree: 1 x 2 clusters halve the columns only. 4096 rows of 4096 + 2048 + ... + 1 and
// three levels more of one column.
TEST(Geometry, LargestTreeFitsIn64Bits) {
  StreamHeader header;
  header.rows = header.cols = 4096;
  header.width = header.height = 65536;
  header.chroma_format = ChromaFormat::k444;
  header.block_log2 = 1;
  header.cluster_rows = 1;
  header.cluster_cols = 2;
  header.tree_height = 15;
  header.levels.assign(16, {1, 1});
  const Geometry geometry(header);
  const uint64_t images = uint64_t{4096} * (8191 + 3);
  EXPECT_EQ(geometry.image_count(), images);
  EXPECT_EQ(geometry.tiles_per_image(), uint64_t{3} << 24);
  EXPECT_EQ(geometry.tile_count(), images * 3 * (uint64_t{1} << 24));
  EXPECT_EQ(geometry.image_number(0, {4095, 4095}), images - 1);
  EXPECT_EQ(geometry.tile_number(images - 1, Plane::kCg, 4095, 4095), geometry.tile_count() - 1);
}

}  // namespace
}  // namespace hmlfc
