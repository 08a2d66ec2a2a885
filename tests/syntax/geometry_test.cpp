// Geometry against a walk over the tree that counts (STR-2 to STR-6, IDX-1 to IDX-3, EXT-3, EXT-4,
// MOT-1, MOT-7).
#include "syntax/geometry.hpp"

#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hmlfc {
namespace {

// A small tree of profile extended: any flags that say something about geometry.
StreamHeader draw_extended_header() {
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
  for (int level = 0; level <= h.tree_height; ++level) {
    const bool may_be_keyed = level < h.tree_height && h.has(Feature::kLevelKeys);
    h.levels.push_back({*rc::gen::inRange<uint8_t>(1, 7), *rc::gen::inRange<uint8_t>(1, 7),
                        may_be_keyed ? *rc::gen::inRange<uint8_t>(0, 2) : uint8_t{0}});
  }
  return h;
}

// How many parts of `part` places cover `size` places: counted.
uint32_t parts(uint32_t size, uint32_t part) {
  uint32_t count = 0;
  for (uint32_t covered = 0; covered < size; covered += part) ++count;
  return count;
}

/// Calls `use(level, image)` for all images of the tree from the top level down, row by row.
template <class Use>
void for_each_image(const StreamHeader& header, const Use& use) {
  std::vector<std::pair<uint32_t, uint32_t>> sizes{{header.rows, header.cols}};
  for (int level = 0; level < header.tree_height; ++level) {
    const auto [rows, cols] = sizes.back();
    sizes.emplace_back(parts(rows, header.cluster_rows), parts(cols, header.cluster_cols));
  }
  for (int level = header.tree_height; level >= 0; --level) {
    const auto [rows, cols] = sizes[static_cast<size_t>(level)];
    for (uint32_t row = 0; row < rows; ++row) {
      for (uint32_t col = 0; col < cols; ++col) use(level, ImagePos{row, col});
    }
  }
}

RC_GTEST_PROP(Geometry, PlanesInSamplesBlocksAndTiles, ()) {
  const StreamHeader header = draw_extended_header();
  const Geometry geometry(header);
  const bool halved = header.chroma_format == ChromaFormat::k420;
  const uint32_t chroma_width = halved ? parts(header.width, 2) : header.width;
  const uint32_t chroma_height = halved ? parts(header.height, 2) : header.height;
  for (const Plane plane : kPlanes) {
    const PlaneShape& shape = geometry.plane(plane);
    RC_ASSERT(shape.width == (plane == Plane::kY ? header.width : chroma_width));
    RC_ASSERT(shape.height == (plane == Plane::kY ? header.height : chroma_height));
    RC_ASSERT(shape.blocks_x == parts(shape.width, 1u << header.block_log2));
    RC_ASSERT(shape.blocks_y == parts(shape.height, 1u << header.block_log2));
    RC_ASSERT(shape.tiles_x == parts(shape.blocks_x, 8));
    RC_ASSERT(shape.tiles_y == parts(shape.blocks_y, 8));
  }
  const bool own_chroma = header.has(Feature::kChromaMotion);
  const size_t motion_planes = !header.has(Feature::kMotionTiles) ? 0 : own_chroma ? 2 : 1;
  RC_ASSERT(geometry.motion_planes().size() == motion_planes);
  for (size_t m = 0; m < motion_planes; ++m) {
    const MotionPlaneShape& shape = geometry.motion_planes()[m];
    RC_ASSERT(shape.width == (m == 0 ? header.width : chroma_width));
    RC_ASSERT(shape.height == (m == 0 ? header.height : chroma_height));
    RC_ASSERT(shape.tiles_x == parts(shape.width, 1u << header.motion_tile_log2));
    RC_ASSERT(shape.tiles_y == parts(shape.height, 1u << header.motion_tile_log2));
    RC_ASSERT(shape.halves == (m == 0 && !own_chroma && halved));
  }
  if (motion_planes == 0) return;
  RC_ASSERT(geometry.motion_plane_of(Plane::kY) == 0);
  RC_ASSERT(geometry.motion_plane_of(Plane::kCo) == motion_planes - 1);
  RC_ASSERT(geometry.motion_plane_of(Plane::kCg) == motion_planes - 1);
}

// Images are numbered breadth-first, tiles image by image, and key images as they come; the motion
// tiles of an image follow the tiles of plane Cg.
RC_GTEST_PROP(Geometry, NumbersCountImagesTilesAndKeys, ()) {
  const StreamHeader header = draw_extended_header();
  const Geometry geometry(header);
  uint64_t image = 0;
  uint64_t tile = 0;
  uint64_t key = 0;
  int64_t views = int64_t{header.rows} * header.cols * (header.tree_height + 1);
  for_each_image(header, [&](int level, ImagePos at) {
    RC_ASSERT(geometry.image_number(level, at) == image);
    for (const Plane plane : kPlanes) {
      const PlaneShape& shape = geometry.plane(plane);
      for (uint32_t i = 0; i < shape.tiles(); ++i, ++tile) {
        const uint64_t number =
            geometry.tile_number(image, plane, i % shape.tiles_x, i / shape.tiles_x);
        RC_ASSERT(number == tile);
      }
    }
    for (size_t m = 0; m < geometry.motion_planes().size(); ++m) {
      const MotionPlaneShape& shape = geometry.motion_planes()[m];
      for (uint32_t i = 0; i < shape.tiles(); ++i, ++tile) {
        const uint64_t number =
            geometry.motion_tile_number(image, m, i % shape.tiles_x, i / shape.tiles_x);
        RC_ASSERT(number == tile);
      }
    }
    const auto& entry = header.levels[static_cast<size_t>(level)];
    const bool keyed = level == header.tree_height || entry.key_references == 1;
    RC_ASSERT(geometry.is_key(level, at) == (keyed && geometry.is_reference(level, at)));
    if (geometry.is_key(level, at)) RC_ASSERT(geometry.key_number(level, at) == key++);
    for (const ImagePos view : geometry.descendants(at, level, 0)) {
      RC_ASSERT(geometry.ancestor(view, 0, level) == at);
      --views;
    }
    for (const ImagePos mate : geometry.group_images(level, at))
      RC_ASSERT(geometry.reference_of(level, mate) == geometry.reference_of(level, at));
    ++image;
  });
  RC_ASSERT(geometry.top() == header.tree_height);
  RC_ASSERT(geometry.image_count() == image);
  RC_ASSERT(views == 0);
  RC_ASSERT(geometry.tile_count() == tile);
  RC_ASSERT(geometry.tile_group_count() == parts(static_cast<uint32_t>(tile), 64));
  RC_ASSERT(geometry.root_entry_count() == parts(static_cast<uint32_t>(tile), 4096));
  RC_ASSERT(geometry.key_count() == key);
}

/// The reference groups of the rows or columns of a level, listed (STR-4, EXT-3, MOT-7).
class Groups {
 public:
  Groups(uint32_t size, uint32_t length, bool balanced) {
    const uint32_t groups = parts(size, length);
    for (uint32_t k = 0; k < groups; ++k)
      begins_.push_back(balanced ? k * size / groups : k * length);
    begins_.push_back(size);
  }

  /// The reference of the group of `at`: the middle place, the lower of two.
  uint32_t own(uint32_t at) const { return middle(group_of(at)); }

  /// Returns the reference of the next group on the side of the reference on which `at` stands,
  /// else on the other.
  uint32_t next(uint32_t at) const {
    const auto group = static_cast<int>(group_of(at));
    const int side = at >= own(at) ? 1 : -1;
    for (const int next : {group + side, group - side}) {
      if (next >= 0 && next + 1 < static_cast<int>(begins_.size())) {
        return middle(static_cast<size_t>(next));
      }
    }
    return own(at);
  }

 private:
  size_t group_of(uint32_t at) const {
    size_t group = 0;
    while (begins_[group + 1] <= at) ++group;
    return group;
  }
  uint32_t middle(size_t group) const { return (begins_[group] + begins_[group + 1] - 1) / 2; }

  std::vector<uint32_t> begins_;
};

RC_GTEST_PROP(Geometry, ReferenceImages, ()) {
  const StreamHeader header = draw_extended_header();
  const Geometry geometry(header);
  const bool balanced = header.has(Feature::kBalancedGroups);
  for_each_image(header, [&](int level, ImagePos at) {
    const LevelEntry& entry = header.levels[static_cast<size_t>(level)];
    const Groups rows(geometry.level(level).rows, entry.ref_rows, balanced);
    const Groups cols(geometry.level(level).cols, entry.ref_cols, balanced);
    const ImagePos own{rows.own(at.row), cols.own(at.col)};
    const ImagePos across{own.row, cols.next(at.col)};
    const ImagePos above{rows.next(at.row), own.col};
    const ImagePos diagonal{above.row, across.col};
    const int from_row = std::abs(static_cast<int>(at.row) - static_cast<int>(own.row));
    const int from_col = std::abs(static_cast<int>(at.col) - static_cast<int>(own.col));
    RC_ASSERT(geometry.reference_of(level, at) == own);
    RC_ASSERT(geometry.is_reference(level, at) == (own == at));
    RC_ASSERT(reference_images(geometry, level, at) ==
              (from_col >= from_row ? ReferenceImages{own, across, above, diagonal}
                                    : ReferenceImages{own, above, across, diagonal}));
  });
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
