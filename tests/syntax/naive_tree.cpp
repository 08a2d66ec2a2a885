#include "syntax/naive_tree.hpp"

#include <cstdlib>

namespace hmlfc::test {
namespace {

// How many parts of `part` places cover `size` places: counted.
uint32_t parts(uint32_t size, uint32_t part) {
  uint32_t count = 0;
  for (uint32_t covered = 0; covered < size; covered += part) ++count;
  return count;
}

// The group that holds `at`: `begins` has the first places of all, and the end.
size_t group_of(const std::vector<uint32_t>& begins, uint32_t at) {
  size_t group = 0;
  while (begins[group + 1] <= at) ++group;
  return group;
}

// The middle place of a group, the lower of two.
uint32_t middle(const std::vector<uint32_t>& begins, size_t group) {
  std::vector<uint32_t> places;
  for (uint32_t place = begins[group]; place < begins[group + 1]; ++place) places.push_back(place);
  return places[(places.size() - 1) / 2];
}

// i' of MOT-7.
size_t neighbour(const std::vector<uint32_t>& begins, uint32_t at) {
  const auto groups = static_cast<int>(begins.size()) - 1;
  const auto own = static_cast<int>(group_of(begins, at));
  const int side = at >= middle(begins, static_cast<size_t>(own)) ? 1 : -1;
  for (const int next : {own + side, own - side}) {
    if (next >= 0 && next < groups) return static_cast<size_t>(next);
  }
  return static_cast<size_t>(own);
}

}  // namespace

NaiveTree::NaiveTree(const StreamHeader& header) : header_(header) {
  NaiveSize size{header.cols, header.rows};
  for (int level = 0; level <= header.tree_height; ++level) {
    levels_.push_back(size);
    size = {parts(size.width, header.cluster_cols), parts(size.height, header.cluster_rows)};
  }
  for (int level = header.tree_height; level >= 0; --level) {
    for (uint32_t row = 0; row < level_size(level).height; ++row) {
      for (uint32_t col = 0; col < level_size(level).width; ++col) {
        images_.push_back({level, row, col});
      }
    }
  }
  for (const NaiveImage& image : images_) {
    for (const Plane plane : planes()) {
      for (uint32_t ty = 0; ty < plane_tiles(plane).height; ++ty) {
        for (uint32_t tx = 0; tx < plane_tiles(plane).width; ++tx) {
          const NaiveTile tile{image, plane, tx, ty};
          numbers_[tile] = tiles_.size();
          tiles_.push_back(tile);
        }
      }
    }
  }
}

NaiveSize NaiveTree::plane_size(Plane plane) const {
  if (plane == Plane::kY || plane == kMotionOfY || header_.chroma_format == ChromaFormat::k444) {
    return {header_.width, header_.height};
  }
  return {parts(header_.width, 2), parts(header_.height, 2)};
}

NaiveSize NaiveTree::plane_blocks(Plane plane) const {
  const NaiveSize size = plane_size(plane);
  uint32_t side = 1;
  for (unsigned i = 0; i < header_.block_log2; ++i) side *= 2;
  return {parts(size.width, side), parts(size.height, side)};
}

NaiveSize NaiveTree::plane_tiles(Plane plane) const {
  if (plane == kMotionOfY || plane == kMotionOfChroma) {
    const NaiveSize size = plane_size(plane);
    uint32_t side = 1;
    for (unsigned i = 0; i < header_.motion_tile_log2; ++i) side *= 2;
    return {parts(size.width, side), parts(size.height, side)};
  }
  const NaiveSize blocks = plane_blocks(plane);
  return {parts(blocks.width, 8), parts(blocks.height, 8)};
}

NaiveImage NaiveTree::parent(const NaiveImage& image) const {
  NaiveImage up{image.level + 1, 0, 0};
  while ((up.row + 1) * header_.cluster_rows <= image.row) ++up.row;
  while ((up.col + 1) * header_.cluster_cols <= image.col) ++up.col;
  return up;
}

NaiveImage NaiveTree::reference(const NaiveImage& image) const { return references(image)[0]; }

std::vector<uint32_t> NaiveTree::group_begins(uint32_t size, uint32_t length) const {
  const uint32_t groups = parts(size, length);
  std::vector<uint32_t> begins;
  for (uint32_t k = 0; k < groups; ++k) {
    begins.push_back(header_.has(Feature::kBalancedGroups) ? k * size / groups : k * length);
  }
  begins.push_back(size);
  return begins;
}

std::array<NaiveImage, 4> NaiveTree::references(const NaiveImage& image) const {
  const LevelEntry& entry = header_.levels[static_cast<size_t>(image.level)];
  const NaiveSize size = level_size(image.level);
  const auto rows = group_begins(size.height, entry.ref_rows);
  const auto cols = group_begins(size.width, entry.ref_cols);
  const uint32_t row = middle(rows, group_of(rows, image.row));
  const uint32_t col = middle(cols, group_of(cols, image.col));
  const uint32_t other_row = middle(rows, neighbour(rows, image.row));
  const uint32_t other_col = middle(cols, neighbour(cols, image.col));
  const NaiveImage h{image.level, row, other_col};
  const NaiveImage v{image.level, other_row, col};
  const int from_row = std::abs(static_cast<int>(image.row) - static_cast<int>(row));
  const int from_col = std::abs(static_cast<int>(image.col) - static_cast<int>(col));
  const NaiveImage own{image.level, row, col};
  const NaiveImage across{image.level, other_row, other_col};
  if (from_col >= from_row) return {own, h, v, across};
  return {own, v, h, across};
}

std::vector<Plane> NaiveTree::planes() const {
  std::vector<Plane> planes{Plane::kY, Plane::kCo, Plane::kCg};
  if (header_.has(Feature::kMotionTiles)) planes.push_back(kMotionOfY);
  if (header_.has(Feature::kChromaMotion)) planes.push_back(kMotionOfChroma);
  return planes;
}

bool NaiveTree::is_key(const NaiveImage& image) const {
  const LevelEntry& entry = header_.levels[static_cast<size_t>(image.level)];
  const bool keyed = image.level == header_.tree_height || entry.key_references == 1;
  return keyed && reference(image) == image;
}

std::vector<NaiveImage> NaiveTree::keys() const {
  std::vector<NaiveImage> keys;
  for (const NaiveImage& image : images_) {
    if (is_key(image)) keys.push_back(image);
  }
  return keys;
}

}  // namespace hmlfc::test
