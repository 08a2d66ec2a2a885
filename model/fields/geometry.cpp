#include "fields/geometry.hpp"

#include <algorithm>

#include "values/rounding.hpp"

namespace hmlfc {
namespace {

// Lanes of a group record and of a root entry (IDX-3, IDX-4).
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

// Row or column of the reference image of the group that holds `at` (STR-4).
uint32_t reference_coordinate(uint32_t at, uint32_t group, uint32_t count) {
  const uint32_t first = group * (at / group);
  const uint32_t size = std::min(group, count - first);
  return first + ((size - 1) >> 1);
}

}  // namespace

Geometry::Geometry(const StreamHeader& header)
    : block_size_(header.block_size()),
      cluster_rows_(header.cluster_rows),
      cluster_cols_(header.cluster_cols) {
  for (const Plane plane : kPlanes) {
    PlaneShape shape = plane_shape(header, plane);
    shape.first_tile = tiles_per_image_;
    tiles_per_image_ += shape.tiles();
    planes_[static_cast<size_t>(plane)] = shape;
  }
  LevelShape shape{header.rows, header.cols, 1, 1, 0};
  for (const LevelEntry& entry : header.levels) {
    shape.ref_rows = entry.ref_rows;
    shape.ref_cols = entry.ref_cols;
    levels_.push_back(shape);
    shape.rows = ceil_div(shape.rows, cluster_rows_);
    shape.cols = ceil_div(shape.cols, cluster_cols_);
  }
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    level->first_image = image_count_;
    image_count_ += level->images();
  }
}

uint64_t Geometry::group_count() const { return ceil_div(tile_count(), kLanes); }

uint64_t Geometry::root_entry_count() const { return ceil_div(group_count(), kLanes); }

uint64_t Geometry::image_number(int l, ImagePos at) const {
  return level(l).first_image + uint64_t{at.row} * level(l).cols + at.col;
}

uint64_t Geometry::tile_number(uint64_t image, Plane p, uint32_t tx, uint32_t ty) const {
  const PlaneShape& shape = plane(p);
  return image * tiles_per_image_ + shape.first_tile + uint64_t{ty} * shape.tiles_x + tx;
}

ImagePos Geometry::ancestor(ImagePos at, int from, int l) const {
  for (int k = from; k < l; ++k) at = {at.row / cluster_rows_, at.col / cluster_cols_};
  return at;
}

ImagePos Geometry::reference_of(int l, ImagePos at) const {
  const LevelShape& shape = level(l);
  return {reference_coordinate(at.row, shape.ref_rows, shape.rows),
          reference_coordinate(at.col, shape.ref_cols, shape.cols)};
}

uint64_t Geometry::key_count() const {
  const LevelShape& shape = level(top());
  return uint64_t{ceil_div(shape.rows, shape.ref_rows)} * ceil_div(shape.cols, shape.ref_cols);
}

uint64_t Geometry::key_number(ImagePos at) const {
  const LevelShape& shape = level(top());
  return uint64_t{at.row / shape.ref_rows} * ceil_div(shape.cols, shape.ref_cols) +
         at.col / shape.ref_cols;
}

}  // namespace hmlfc
