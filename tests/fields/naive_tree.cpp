#include "fields/naive_tree.hpp"

namespace hmlfc::test {
namespace {

// How many parts of `part` places cover `size` places: counted.
uint32_t parts(uint32_t size, uint32_t part) {
  uint32_t count = 0;
  for (uint32_t covered = 0; covered < size; covered += part) ++count;
  return count;
}

// The places of the group that holds `at`, when [0, size) is cut into groups of `length`.
std::vector<uint32_t> group_of(uint32_t at, uint32_t size, uint32_t length) {
  std::vector<uint32_t> group;
  for (uint32_t place = 0; place < size; ++place) {
    if (place % length == 0) {
      if (!group.empty() && group.back() >= at) break;
      group.clear();
    }
    group.push_back(place);
  }
  return group;
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
    for (const Plane plane : kPlanes) {
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
  if (plane == Plane::kY || header_.chroma_format == ChromaFormat::k444) {
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
  const NaiveSize blocks = plane_blocks(plane);
  return {parts(blocks.width, 8), parts(blocks.height, 8)};
}

NaiveImage NaiveTree::parent(const NaiveImage& image) const {
  NaiveImage up{image.level + 1, 0, 0};
  while ((up.row + 1) * header_.cluster_rows <= image.row) ++up.row;
  while ((up.col + 1) * header_.cluster_cols <= image.col) ++up.col;
  return up;
}

NaiveImage NaiveTree::reference(const NaiveImage& image) const {
  const LevelEntry& entry = header_.levels[static_cast<size_t>(image.level)];
  const NaiveSize size = level_size(image.level);
  const auto rows = group_of(image.row, size.height, entry.ref_rows);
  const auto cols = group_of(image.col, size.width, entry.ref_cols);
  return {image.level, rows[(rows.size() - 1) / 2], cols[(cols.size() - 1) / 2]};
}

std::vector<NaiveImage> NaiveTree::keys() const {
  std::vector<NaiveImage> keys;
  for (const NaiveImage& image : images_) {
    if (image.level == header_.tree_height && reference(image) == image) keys.push_back(image);
  }
  return keys;
}

}  // namespace hmlfc::test
