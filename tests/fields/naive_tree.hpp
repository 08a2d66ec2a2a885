// The tree of a small light field spelled out: every image and tile listed, nothing computed that
// can be counted (STR-2 to STR-6, IDX-1 to IDX-3).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <hmlfc/format.hpp>

namespace hmlfc::test {

/// One image of the tree.
struct NaiveImage {
  int level = 0;
  uint32_t row = 0;
  uint32_t col = 0;
  friend auto operator<=>(const NaiveImage&, const NaiveImage&) = default;
};

/// One tile of one plane of an image.
struct NaiveTile {
  NaiveImage image;
  Plane plane = Plane::kY;
  uint32_t tx = 0;
  uint32_t ty = 0;
  friend auto operator<=>(const NaiveTile&, const NaiveTile&) = default;
};

struct NaiveSize {
  uint32_t width = 0;
  uint32_t height = 0;
};

class NaiveTree {
 public:
  explicit NaiveTree(const StreamHeader& header);

  /// Width is columns, height rows.
  NaiveSize level_size(int level) const { return levels_[static_cast<size_t>(level)]; }
  NaiveSize plane_size(Plane plane) const;
  NaiveSize plane_blocks(Plane plane) const;
  NaiveSize plane_tiles(Plane plane) const;

  /// All images and tiles; the place in the list is the number.
  const std::vector<NaiveImage>& images() const { return images_; }
  const std::vector<NaiveTile>& tiles() const { return tiles_; }

  /// The numbers of the tiles listed above.
  uint64_t tile_number(const NaiveTile& tile) const { return numbers_.at(tile); }

  NaiveImage parent(const NaiveImage& image) const;
  NaiveImage reference(const NaiveImage& image) const;

  /// The key images in ascending image numbers.
  std::vector<NaiveImage> keys() const;

 private:
  StreamHeader header_;
  std::vector<NaiveSize> levels_;
  std::vector<NaiveImage> images_;
  std::vector<NaiveTile> tiles_;
  std::map<NaiveTile, uint64_t> numbers_;
};

}  // namespace hmlfc::test
