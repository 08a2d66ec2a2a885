// The shape of the tree and its numbering, derived from the header (STR-2 to STR-6, IDX-1 to
// IDX-3, EXT-3, EXT-4, MOT-1, MOT-7).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include <hmlfc/format.hpp>

namespace hmlfc {
/// A place in the grid of images of one level.
struct ImagePos {
  uint32_t row = 0;
  uint32_t col = 0;
  /// The order of images is row by row.
  friend auto operator<=>(const ImagePos&, const ImagePos&) = default;
};

/// Rows (columns) from image `from` to image `to`; both below 2^12.
constexpr int32_t row_offset(ImagePos to, ImagePos from) {
  return static_cast<int32_t>(to.row) - static_cast<int32_t>(from.row);
}
constexpr int32_t col_offset(ImagePos to, ImagePos from) {
  return static_cast<int32_t>(to.col) - static_cast<int32_t>(from.col);
}

/// Images [row0, row1) x [col0, col1) of one level, not empty, row by row.
struct ImageRange {
  uint32_t row0 = 0;
  uint32_t row1 = 0;
  uint32_t col0 = 0;
  uint32_t col1 = 0;

  struct Iterator {
    ImagePos at;
    uint32_t col0;
    uint32_t col1;

    ImagePos operator*() const { return at; }
    Iterator& operator++() {
      if (++at.col == col1) at = {at.row + 1, col0};
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at == b.at; }
  };
  Iterator begin() const { return {{row0, col0}, col0, col1}; }
  Iterator end() const { return {{row1, col0}, col0, col1}; }
};

/// Size of one plane in samples, blocks and tiles (STR-2, STR-6).
struct PlaneShape {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t blocks_x = 0;
  uint32_t blocks_y = 0;
  uint32_t tiles_x = 0;
  uint32_t tiles_y = 0;
  uint64_t first_tile = 0;  ///< number of the plane's first tile within an image (IDX-2)

  uint64_t tiles() const { return uint64_t{tiles_x} * tiles_y; }
  uint64_t samples() const { return uint64_t{width} * height; }
};

/// One motion plane in samples and motion tiles (MOT-1).
struct MotionPlaneShape {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t tiles_x = 0;
  uint32_t tiles_y = 0;
  uint64_t first_tile = 0;  ///< number of its first tile within an image (IDX-2)
  bool halves = false;      ///< also serves planes of half its width and height (MOT-4)

  uint64_t tiles() const { return uint64_t{tiles_x} * tiles_y; }
};

/// One level of the tree (STR-3, STR-4).
struct LevelShape {
  uint32_t rows = 0;
  uint32_t cols = 0;
  uint32_t ref_rows = 1;
  uint32_t ref_cols = 1;
  uint64_t first_image = 0;  ///< F_l of IDX-1
  bool keyed = false;        ///< its reference images are key images (EXT-4)
  bool balanced = false;     ///< its reference groups are those of EXT-3
  uint64_t first_key = 0;    ///< number of its first key image, in ascending image numbers (KEY-1)

  uint32_t group_rows() const;
  uint32_t group_cols() const;

  uint64_t images() const { return uint64_t{rows} * cols; }
  ImageRange all_images() const { return {0, rows, 0, cols}; }
};

/// A motion tile of one image (MOT-1).
struct MotionTilePlace {
  int level = 0;
  ImagePos image;
  size_t motion_plane = 0;  ///< index in Geometry::motion_planes()
  uint32_t tx = 0;
  uint32_t ty = 0;

  friend bool operator==(const MotionTilePlace&, const MotionTilePlace&) = default;
};

/// Everything that follows from the header alone. Immutable.
class Geometry {
 public:
  /// `header` has passed check_fields.
  explicit Geometry(const StreamHeader& header);

  int top() const { return static_cast<int>(levels_.size()) - 1; }
  unsigned block_size() const { return block_size_; }
  const LevelShape& level(int l) const { return levels_[static_cast<size_t>(l)]; }
  const PlaneShape& plane(Plane p) const { return planes_[static_cast<size_t>(p)]; }

  uint64_t image_count() const { return image_count_; }
  uint64_t tiles_per_image() const { return tiles_per_image_; }
  uint64_t tile_count() const { return image_count_ * tiles_per_image_; }
  uint64_t tile_group_count() const;
  uint64_t root_entry_count() const;

  /// The number of image `at` of level `l` (IDX-1).
  uint64_t image_number(int l, ImagePos at) const;

  /// The number of tile (tx, ty) of plane `p` of image number `image` (IDX-2).
  uint64_t tile_number(uint64_t image, Plane p, uint32_t tx, uint32_t ty) const;

  /// The motion planes: none, one or two (MOT-1).
  const std::vector<MotionPlaneShape>& motion_planes() const { return motion_planes_; }

  /// Index in motion_planes() of the one that serves plane `p`; there is one (MOT-1).
  size_t motion_plane_of(Plane p) const { return p == Plane::kY ? 0 : motion_planes_.size() - 1; }

  /// The number of motion tile (tx, ty) of motion plane `m` of image number `image` (IDX-2, MOT-1).
  uint64_t motion_tile_number(uint64_t image, size_t m, uint32_t tx, uint32_t ty) const;

  /// The ancestor at level `l` of image `at` of level `from`, from <= l (DEC-1).
  ImagePos ancestor(ImagePos at, int from, int l) const;

  /// The images of level `l` whose ancestor at level `from` is image `at`, l <= from.
  ImageRange descendants(ImagePos at, int from, int l) const;

  /// The reference image of the group of image `at` of level `l` (STR-4).
  ImagePos reference_of(int l, ImagePos at) const;

  bool is_reference(int l, ImagePos at) const { return reference_of(l, at) == at; }

  /// Row and column of the reference group of image `at` of level `l` (STR-4, EXT-3).
  ImagePos group_of(int l, ImagePos at) const;

  /// The images of the reference group of image `at` of level `l`.
  ImageRange group_images(int l, ImagePos at) const;

  /// The reference image of group `group` of level `l` (STR-4, EXT-3).
  ImagePos reference_of_group(int l, ImagePos group) const;

  /// Key images are the reference images of keyed levels (STR-5, EXT-4).
  bool is_key(int l, ImagePos at) const { return level(l).keyed && is_reference(l, at); }

  /// Number of key images.
  uint64_t key_count() const { return key_count_; }

  /// The rank of key image `at` of keyed level `l` among all key images (KEY-1).
  uint64_t key_number(int l, ImagePos at) const;

 private:
  std::vector<LevelShape> levels_;
  std::array<PlaneShape, kPlaneCount> planes_;
  std::vector<MotionPlaneShape> motion_planes_;
  unsigned block_size_;
  uint32_t cluster_rows_;
  uint32_t cluster_cols_;
  uint64_t image_count_ = 0;
  uint64_t tiles_per_image_ = 0;
  uint64_t key_count_ = 0;

  void add_planes(const StreamHeader& header);
  void add_levels(const StreamHeader& header);
};

/// K0, K1, K2 and K3 of MOT-7; some may be the same image.
using ReferenceImages = std::array<ImagePos, 4>;

/// The reference images of image `at` of level `l`.
ReferenceImages reference_images(const Geometry& geometry, int l, ImagePos at);

/// The meaning of a value of reference_set: one or two of K0 to K3.
struct ReferenceSet {
  unsigned count;                    ///< 1 or 2
  std::array<uint8_t, 2> reference;  ///< twice the same with count 1
};
constexpr unsigned kReferenceSets = 8;

/// The references of `reference_set` in [0, 7].
constexpr ReferenceSet references_of_set(unsigned reference_set) {
  constexpr std::array<ReferenceSet, kReferenceSets> kSets{{{1, {0, 0}},
                                                            {2, {0, 1}},
                                                            {2, {0, 2}},
                                                            {1, {1, 1}},
                                                            {1, {2, 2}},
                                                            {2, {1, 2}},
                                                            {2, {0, 3}},
                                                            {1, {3, 3}}}};
  return kSets[reference_set];
}

}  // namespace hmlfc
