#include "syntax/geometry.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {
namespace {

// Tiles of a tile group, and tile groups of a root entry (IDX-3, IDX-4).
constexpr uint64_t kLanes = 64;

PlaneShape plane_shape(const StreamHeader& header, Plane plane) {
  const bool halved = plane != Plane::kY && header.chroma_format == ChromaFormat::k420;
  PlaneShape shape;
  shape.width = halved ? ceil_div(header.width, 2u) : header.width;
  shape.height = halved ? ceil_div(header.height, 2u) : header.height;
  shape.blocks_x = ceil_div(shape.width, header.block_size());
  shape.blocks_y = ceil_div(shape.height, header.block_size());
  shape.tiles_x = ceil_div(shape.blocks_x, kTileBlocks);
  shape.tiles_y = ceil_div(shape.blocks_y, kTileBlocks);
  return shape;
}

MotionPlaneShape motion_plane_shape(const PlaneShape& plane, unsigned tile_log2) {
  MotionPlaneShape shape;
  shape.width = plane.width;
  shape.height = plane.height;
  shape.tiles_x = ceil_div(plane.width, 1u << tile_log2);
  shape.tiles_y = ceil_div(plane.height, 1u << tile_log2);
  return shape;
}

// The reference groups of one row or column of `count` images, in groups of `size` (STR-4, EXT-3).
struct GroupLine {
  uint32_t count;
  uint32_t size;
  bool balanced;

  uint32_t groups() const { return ceil_div(count, size); }

  uint32_t group_of(uint32_t at) const {
    return balanced ? ((at + 1) * groups() - 1) / count : at / size;
  }

  uint32_t begin(uint32_t group) const {
    return balanced ? group * count / groups() : std::min(group * size, count);
  }

  uint32_t reference_of(uint32_t group) const {
    const uint32_t first = begin(group);
    return first + ((begin(group + 1) - first - 1) >> 1);
  }
};

GroupLine row_groups(const LevelShape& level) {
  return {level.rows, level.ref_rows, level.balanced};
}
GroupLine col_groups(const LevelShape& level) {
  return {level.cols, level.ref_cols, level.balanced};
}

}  // namespace

uint32_t LevelShape::group_rows() const { return row_groups(*this).groups(); }
uint32_t LevelShape::group_cols() const { return col_groups(*this).groups(); }

Geometry::Geometry(const StreamHeader& header)
    : block_size_(header.block_size()),
      cluster_rows_(header.cluster_rows),
      cluster_cols_(header.cluster_cols) {
  add_planes(header);
  add_levels(header);
}

void Geometry::add_planes(const StreamHeader& header) {
  for (const Plane plane : kPlanes) {
    PlaneShape shape = plane_shape(header, plane);
    shape.first_tile = tiles_per_image_;
    tiles_per_image_ += shape.tiles();
    planes_[static_cast<size_t>(plane)] = shape;
  }
  if (!header.has(Feature::kMotionTiles)) return;
  const bool own_chroma = header.has(Feature::kChromaMotion);
  motion_planes_.push_back(motion_plane_shape(plane(Plane::kY), header.motion_tile_log2));
  motion_planes_[0].halves = !own_chroma && header.chroma_format == ChromaFormat::k420;
  if (own_chroma) {
    motion_planes_.push_back(motion_plane_shape(plane(Plane::kCo), header.motion_tile_log2));
  }
  for (MotionPlaneShape& shape : motion_planes_) {
    shape.first_tile = tiles_per_image_;
    tiles_per_image_ += shape.tiles();
  }
}

void Geometry::add_levels(const StreamHeader& header) {
  LevelShape shape;
  shape.rows = header.rows;  // the views of level 0 (STR-1)
  shape.cols = header.cols;
  shape.balanced = header.has(Feature::kBalancedGroups);
  for (const LevelEntry& entry : header.levels) {
    shape.ref_rows = entry.ref_rows;
    shape.ref_cols = entry.ref_cols;
    shape.keyed = entry.key_references != 0;
    levels_.push_back(shape);
    shape.rows = ceil_div(shape.rows, cluster_rows_);
    shape.cols = ceil_div(shape.cols, cluster_cols_);
  }
  if (!levels_.empty()) levels_.back().keyed = true;
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    level->first_image = image_count_;
    level->first_key = key_count_;
    image_count_ += level->images();
    if (level->keyed) key_count_ += uint64_t{level->group_rows()} * level->group_cols();
  }
}

uint64_t Geometry::tile_group_count() const { return ceil_div(tile_count(), kLanes); }

uint64_t Geometry::root_entry_count() const { return ceil_div(tile_group_count(), kLanes); }

uint64_t Geometry::image_number(int l, ImagePos at) const {
  const uint64_t image = level(l).first_image + uint64_t{at.row} * level(l).cols + at.col;
  watch("image number", narrow<int64_t>(image));
  return image;
}

uint64_t Geometry::tile_number(uint64_t image, Plane p, uint32_t tx, uint32_t ty) const {
  const PlaneShape& shape = plane(p);
  const uint64_t tile =
      image * tiles_per_image_ + shape.first_tile + uint64_t{ty} * shape.tiles_x + tx;
  watch("tile number", narrow<int64_t>(tile));
  return tile;
}

ImagePos Geometry::ancestor(ImagePos at, int from, int l) const {
  for (int k = from; k < l; ++k) at = {at.row / cluster_rows_, at.col / cluster_cols_};
  return at;
}

ImageRange Geometry::descendants(ImagePos at, int from, int l) const {
  constexpr uint64_t kBeyondAll = uint64_t{1} << 32;  // 255^15 overflows
  uint64_t rows = 1;
  uint64_t cols = 1;
  for (int k = l; k < from; ++k) {
    rows = std::min(rows * cluster_rows_, kBeyondAll);
    cols = std::min(cols * cluster_cols_, kBeyondAll);
  }
  const auto end = [](uint64_t beyond, uint32_t count) {
    return static_cast<uint32_t>(std::min<uint64_t>(beyond, count));
  };
  return {static_cast<uint32_t>(at.row * rows), end((at.row + 1) * rows, level(l).rows),
          static_cast<uint32_t>(at.col * cols), end((at.col + 1) * cols, level(l).cols)};
}

uint64_t Geometry::motion_tile_number(uint64_t image, size_t m, uint32_t tx, uint32_t ty) const {
  const MotionPlaneShape& shape = motion_planes_[m];
  const uint64_t tile =
      image * tiles_per_image_ + shape.first_tile + uint64_t{ty} * shape.tiles_x + tx;
  watch("tile number", narrow<int64_t>(tile));
  return tile;
}

ImagePos Geometry::group_of(int l, ImagePos at) const {
  return {row_groups(level(l)).group_of(at.row), col_groups(level(l)).group_of(at.col)};
}

ImageRange Geometry::group_images(int l, ImagePos at) const {
  const GroupLine rows = row_groups(level(l));
  const GroupLine cols = col_groups(level(l));
  const ImagePos group = group_of(l, at);
  return {rows.begin(group.row), rows.begin(group.row + 1), cols.begin(group.col),
          cols.begin(group.col + 1)};
}

ImagePos Geometry::reference_of_group(int l, ImagePos group) const {
  return {row_groups(level(l)).reference_of(group.row),
          col_groups(level(l)).reference_of(group.col)};
}

ImagePos Geometry::reference_of(int l, ImagePos at) const {
  return reference_of_group(l, group_of(l, at));
}

uint64_t Geometry::key_number(int l, ImagePos at) const {
  const ImagePos group = group_of(l, at);
  return level(l).first_key + uint64_t{group.row} * level(l).group_cols() + group.col;
}

namespace {

// i' of MOT-7: the reference group next to `group`, of `groups`, on that side of its reference
// image (at `reference`) on which `at` lies.
uint32_t next_group(uint32_t group, uint32_t groups, uint32_t at, uint32_t reference) {
  if (groups == 1) return group;
  const bool up = at >= reference ? group + 1 < groups : group == 0;
  return up ? group + 1 : group - 1;
}

uint32_t distance(uint32_t a, uint32_t b) { return a > b ? a - b : b - a; }

}  // namespace

ReferenceImages reference_images(const Geometry& geometry, int l, ImagePos at) {
  const LevelShape& level = geometry.level(l);
  const ImagePos group = geometry.group_of(l, at);
  const ImagePos own = geometry.reference_of_group(l, group);
  const uint32_t row = next_group(group.row, level.group_rows(), at.row, own.row);
  const uint32_t col = next_group(group.col, level.group_cols(), at.col, own.col);
  const ImagePos beside = geometry.reference_of_group(l, {group.row, col});
  const ImagePos above = geometry.reference_of_group(l, {row, group.col});
  const bool beside_first = distance(at.col, own.col) >= distance(at.row, own.row);
  return {own, beside_first ? beside : above, beside_first ? above : beside,
          geometry.reference_of_group(l, {row, col})};
}

}  // namespace hmlfc
