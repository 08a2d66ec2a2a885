// The tree of a small light field spelled out: every image and tile listed, nothing computed that
// can be counted (STR-2 to STR-6, IDX-1 to IDX-3, EXT-3, EXT-4, MOT-1, MOT-7).
#pragma once

#include <array>
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

/// The motion planes (MOT-1), as planes of tiles.
inline constexpr Plane kMotionOfY{3};
inline constexpr Plane kMotionOfChroma{4};

/// One tile of one plane of an image, or one motion tile of one motion plane.
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

  /// K0 to K3 of MOT-7.
  std::array<NaiveImage, 4> references(const NaiveImage& image) const;

  /// The planes that have tiles: Y, Co, Cg and the motion planes.
  std::vector<Plane> planes() const;
  bool is_key(const NaiveImage& image) const;

  /// The key images in ascending image numbers.
  std::vector<NaiveImage> keys() const;

 private:
  /// The first places of all groups of a row or column of images, and the end.
  std::vector<uint32_t> group_begins(uint32_t size, uint32_t length) const;

  StreamHeader header_;
  std::vector<NaiveSize> levels_;
  std::vector<NaiveImage> images_;
  std::vector<NaiveTile> tiles_;
  std::map<NaiveTile, uint64_t> numbers_;
};

}  // namespace hmlfc::test
