// Geometry against a tree in which everything is listed (STR-2 to STR-6, IDX-1 to IDX-3, DEC-1,
// EXT-3, EXT-4, MOT-1, MOT-7).
#include "syntax/geometry.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "syntax/geometry.hpp"
#include "syntax/naive_header.hpp"
#include "syntax/naive_tree.hpp"

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

// The same of profile extended: any flags that say something about geometry.
StreamHeader draw_extended_header() {
  StreamHeader h = draw_small_header();
  h.profile = Profile::kExtended;
  const auto flag = [&](Feature feature) {
    if (*rc::gen::arbitrary<bool>()) h.feature_flags |= feature_bit(feature);
  };
  flag(Feature::kBalancedGroups);
  flag(Feature::kLevelKeys);
  flag(Feature::kMotionTiles);
  if (h.has(Feature::kMotionTiles)) {
    flag(Feature::kChromaMotion);
    h.motion_tile_log2 = *rc::gen::inRange(5u, 8u);
  }
  for (int level = 0; level < h.tree_height; ++level) {
    h.levels[static_cast<size_t>(level)].key_references =
        h.has(Feature::kLevelKeys) ? *rc::gen::inRange<uint8_t>(0, 2) : 0;
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

// Tile numbers are 0, 1, 2, ... over all tiles, a bijection; those of motion tiles follow those of
// plane Cg.
void check_tile_numbers(const StreamHeader& header) {
  const Geometry geometry(header);
  const NaiveTree tree(header);
  const uint64_t count = tree.tiles().size();
  RC_ASSERT(geometry.tile_count() == count);
  RC_ASSERT(geometry.tile_group_count() == (count - 1) / 64 + 1);
  RC_ASSERT(geometry.root_entry_count() == (count - 1) / 4096 + 1);
  RC_ASSERT(geometry.motion_planes().size() == tree.planes().size() - 3);
  for (uint64_t number = 0; number < count; ++number) {
    const NaiveTile& tile = tree.tiles()[number];
    const uint64_t image = geometry.image_number(tile.image.level, pos(tile.image));
    const auto plane = static_cast<size_t>(tile.plane);
    if (plane < 3) {
      RC_ASSERT(geometry.tile_number(image, tile.plane, tile.tx, tile.ty) == number);
    } else {
      RC_ASSERT(geometry.motion_tile_number(image, plane - 3, tile.tx, tile.ty) == number);
      const MotionPlaneShape& shape = geometry.motion_planes()[plane - 3];
      const NaiveSize size = tree.plane_size(tile.plane);
      RC_ASSERT(shape.width == size.width && shape.height == size.height);
    }
  }
}

RC_GTEST_PROP(Geometry, TileNumbersCountAllTiles, ()) { check_tile_numbers(draw_small_header()); }

RC_GTEST_PROP(Geometry, TileNumbersOfProfileExtended, ()) {
  const StreamHeader header = draw_extended_header();
  check_tile_numbers(header);
  if (!header.has(Feature::kMotionTiles)) return;
  const Geometry geometry(header);
  const bool own_chroma = header.has(Feature::kChromaMotion);
  RC_ASSERT(geometry.motion_plane_of(Plane::kY) == 0);
  RC_ASSERT(geometry.motion_plane_of(Plane::kCo) == (own_chroma ? 1u : 0u));
  RC_ASSERT(geometry.motion_plane_of(Plane::kCg) == (own_chroma ? 1u : 0u));
  RC_ASSERT(geometry.motion_planes()[0].halves ==
            (!own_chroma && header.chroma_format == ChromaFormat::k420));
}

void check_references(const StreamHeader& header) {
  const Geometry geometry(header);
  const NaiveTree tree(header);
  for (const NaiveImage& image : tree.images()) {
    const NaiveImage reference = tree.reference(image);
    RC_ASSERT(geometry.reference_of(image.level, pos(image)) == pos(reference));
    RC_ASSERT(geometry.is_reference(image.level, pos(image)) == (reference == image));
    RC_ASSERT(geometry.is_key(image.level, pos(image)) == tree.is_key(image));
    const auto expected = tree.references(image);
    const ReferenceImages found = reference_images(geometry, image.level, pos(image));
    for (size_t k = 0; k < 4; ++k) RC_ASSERT(found[k] == pos(expected[k]));
  }
  const auto keys = tree.keys();
  RC_ASSERT(geometry.key_count() == keys.size());
  for (uint64_t number = 0; number < keys.size(); ++number) {
    RC_ASSERT(geometry.key_number(keys[number].level, pos(keys[number])) == number);
  }
}

RC_GTEST_PROP(Geometry, ReferencesAndKeys, ()) {
  const StreamHeader header = draw_small_header();
  check_references(header);
  const NaiveTree tree(header);
  for (const NaiveImage& image : tree.images()) {
    const bool top = image.level == header.tree_height;
    RC_ASSERT(tree.is_key(image) == (top && tree.reference(image) == image));
  }
}

RC_GTEST_PROP(Geometry, ReferencesAndKeysOfProfileExtended, ()) {
  check_references(draw_extended_header());
}

// Every number of rows up to 600 in groups of every size: the boundaries of EXT-3, found by
// walking over the rows. No group is longer than STR-4 allows, none longer than another by 2.
TEST(Geometry, BalancedGroupsOfEveryLength) {
  StreamHeader header;
  header.profile = Profile::kExtended;
  header.feature_flags = feature_bit(Feature::kBalancedGroups);
  for (uint32_t rows = 1; rows <= 600; rows += rows < 40 ? 1 : 23) {
    header.rows = rows;
    for (uint32_t length = 1; length <= 255; ++length) {
      header.levels = {{static_cast<uint8_t>(length), 1}};
      const Geometry geometry(header);
      const uint32_t groups = (rows + length - 1) / length;
      ASSERT_EQ(geometry.level(0).group_rows(), groups);
      for (uint32_t group = 0; group < groups; ++group) {
        const uint32_t begin = group * rows / groups;
        const uint32_t end = (group + 1) * rows / groups;
        ASSERT_LE(end - begin, length);
        ASSERT_GE(end - begin, rows / groups);
        ASSERT_LE(end - begin, rows / groups + 1);
        for (uint32_t row = begin; row < end; ++row) {
          ASSERT_EQ(geometry.group_of(0, {row, 0}).row, group) << row << " of " << rows;
          ASSERT_EQ(geometry.reference_of(0, {row, 0}).row, begin + (end - begin - 1) / 2);
        }
      }
    }
  }
}

TEST(Geometry, ReferenceSetsByHand) {
  StreamHeader header = test::some_header(0);  // 5 x 7 views
  header.levels = {{2, 3}};
  const Geometry geometry(header);
  // Rows of groups 0-1, 2-3, 4 with references in 0, 2, 4; columns 0-2, 3-5, 6 with 1, 4, 6.
  // View (3, 5): below and right of K0 = (2, 4); as far in both, so that K1 is beside.
  EXPECT_EQ(reference_images(geometry, 0, {3, 5}),
            (ReferenceImages{{{2, 4}, {2, 6}, {4, 4}, {4, 6}}}));
  // View (3, 4): in the column of K0, whose other group is the next; K1 is below.
  EXPECT_EQ(reference_images(geometry, 0, {3, 4}),
            (ReferenceImages{{{2, 4}, {4, 4}, {2, 6}, {4, 6}}}));
  // View (1, 0): the first row of groups, right of no group: the groups on the other side.
  EXPECT_EQ(reference_images(geometry, 0, {1, 0}),
            (ReferenceImages{{{0, 1}, {0, 4}, {2, 1}, {2, 4}}}));
  // One row of groups alone.
  header.levels = {{5, 3}};
  EXPECT_EQ(reference_images(Geometry(header), 0, {0, 3}),
            (ReferenceImages{{{2, 4}, {2, 4}, {2, 1}, {2, 1}}}));
  const std::vector<std::vector<int>> sets{{0}, {0, 1}, {0, 2}, {1}, {2}, {1, 2}, {0, 3}, {3}};
  for (unsigned set = 0; set < 8; ++set) {
    const ReferenceSet found = references_of_set(set);
    ASSERT_EQ(found.count, sets[set].size());
    for (size_t i = 0; i < found.count; ++i) EXPECT_EQ(found.reference[i], sets[set][i]);
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
