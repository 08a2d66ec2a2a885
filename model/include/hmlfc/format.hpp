// The vocabulary of an HMLFC stream: places, planes, profiles, header fields (specification,
// sections 2 and 3).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hmlfc {

inline constexpr uint32_t kMaxGrid = 4096;   ///< of rows and of cols (FIL-1)
inline constexpr uint32_t kMaxSide = 65536;  ///< of width and of height, pixels
inline constexpr int kMaxTreeHeight = 15;    ///< of tree_height
inline constexpr int kMaxWindow = 127;       ///< of window, samples

/// The planes of YCoCg-R that a view is coded in (COL-1).
enum class Plane : uint8_t { kY = 0, kCo = 1, kCg = 2 };
inline constexpr int kPlaneCount = 3;
/// All planes in their order.
inline constexpr std::array<Plane, kPlaneCount> kPlanes{Plane::kY, Plane::kCo, Plane::kCg};

/// A place in the grid of views.
struct ViewPos {
  uint32_t row = 0;  ///< [0, rows - 1]
  uint32_t col = 0;  ///< [0, cols - 1]
};

/// One block of one view.
struct BlockAddress {
  ViewPos view;             ///< the view
  Plane plane = Plane::kY;  ///< a plane of it
  uint32_t bx = 0;          ///< block column, [0, ceil(plane width / B) - 1]
  uint32_t by = 0;          ///< block row, [0, ceil(plane height / B) - 1]
};

/// A rectangle in samples of a plane, or in pixels of a view. Its sides are at least 1.
struct Rect {
  uint32_t x = 0;       ///< left column
  uint32_t y = 0;       ///< top row
  uint32_t width = 0;   ///< columns
  uint32_t height = 0;  ///< rows
};

/// Size of a plane in samples.
struct PlaneSize {
  uint32_t width = 0;   ///< [1, 65536]
  uint32_t height = 0;  ///< [1, 65536]
};

/// The sets of tools that a stream may use (EXT-1).
enum class Profile : uint8_t { kMain = 0, kExtended = 1 };

/// The tools of profile extended: bits of feature_flags (EXT-1).
enum class Feature : uint8_t {
  kResidualStep = 0,
  kMotionTiles = 1,
  kSubpelVectors = 2,
  kSharedDisparity = 3,
  kTwoReferences = 4,
  kChromaMotion = 5,
  kLossyKeys = 6,
  kLevelKeys = 7,
  kBalancedGroups = 8,
  kCameraRig = 9,
};
inline constexpr unsigned kFeatureCount = 10;

/// The specification's name of `feature`.
constexpr std::string_view feature_name(Feature feature) {
  constexpr std::array<std::string_view, kFeatureCount> kNames{
      "residual_step", "motion_tiles", "subpel_vectors", "shared_disparity", "two_references",
      "chroma_motion", "lossy_keys",   "level_keys",     "balanced_groups",  "camera_rig"};
  return kNames[static_cast<size_t>(feature)];
}

/// The flag of `feature` as it stands in feature_flags.
constexpr uint32_t feature_bit(Feature feature) { return 1u << static_cast<unsigned>(feature); }

/// Whether Co and Cg have half the width and height of Y, rounded up, or its size (COL-2).
enum class ChromaFormat : uint8_t { k420 = 0, k444 = 1 };

/// Parts of a block that are coded (TIL-5).
enum class BlockState : uint8_t { kZero, kMotion, kMotionResidual, kResidual };

/// "main" or "extended".
constexpr std::string_view profile_name(Profile profile) {
  return profile == Profile::kMain ? "main" : "extended";
}

/// "Y", "Co" or "Cg".
constexpr std::string_view plane_name(Plane plane) {
  constexpr std::array<std::string_view, kPlaneCount> kNames{"Y", "Co", "Cg"};
  return kNames[static_cast<size_t>(plane)];
}

/// "zero", "motion only", "motion and residual" or "residual only".
constexpr std::string_view state_name(BlockState state) {
  constexpr std::array<std::string_view, 4> kNames{"zero", "motion only", "motion and residual",
                                                   "residual only"};
  return kNames[static_cast<size_t>(state)];
}

/// Blocks of a tile are 8 x 8 (STR-6).
inline constexpr unsigned kTileBlocks = 8;

/// Reference groups of one level (FIL-2).
struct LevelEntry {
  uint8_t ref_rows = 1;        ///< [1, 255]
  uint8_t ref_cols = 1;        ///< [1, 255]
  uint8_t key_references = 0;  ///< 1: the level's reference images are key images (EXT-4)

  friend bool operator==(const LevelEntry&, const LevelEntry&) = default;
};

/// One section of the file (FIL-3).
struct SectionEntry {
  uint32_t type = 0;    ///< 1 TOP, 2 ROOT, 3 GROUP, 4 TILE, 5 RIG
  uint32_t crc = 0;     ///< CRC-32C of the section
  uint64_t offset = 0;  ///< bytes from the start of the file
  uint64_t size = 0;    ///< bytes

  friend bool operator==(const SectionEntry&, const SectionEntry&) = default;
};

/// The header's fields under the names of their table (FIL-1).
struct StreamHeader {
  Profile profile = Profile::kMain;                 ///< the set of tools
  uint32_t feature_flags = 0;                       ///< sum of feature_bit
  uint32_t rows = 1;                                ///< of views, [1, 4096]
  uint32_t cols = 1;                                ///< of views, [1, 4096]
  uint32_t width = 1;                               ///< of a view in pixels, [1, 65536]
  uint32_t height = 1;                              ///< [1, 65536]
  int depth = 8;                                    ///< bits a sample, [8, 12]
  ChromaFormat chroma_format = ChromaFormat::k420;  ///< size of Co and Cg
  unsigned block_log2 = 2;                          ///< [1, 3]
  int window = 16;                                  ///< [0, 127] samples
  uint32_t cluster_rows = 2;               ///< images of a level under one parent, [1, 255]
  uint32_t cluster_cols = 2;               ///< [1, 255]
  int tree_height = 0;                     ///< [0, 15]
  unsigned vector_precision = 0;           ///< [0, 3] (EXT-2)
  unsigned disparity_precision = 0;        ///< [vector_precision, 5]
  unsigned motion_tile_log2 = 0;           ///< [5, 7], or 0 without motion tiles
  unsigned disparity_grid_log2 = 0;        ///< [2, 5], or 0 without disparities
  int row_scale = 0;                       ///< distance of rows in 1/16 columns, [-127, 127]
  std::vector<LevelEntry> levels;          ///< index = level, [0, tree_height]
  std::array<SectionEntry, 4> sections{};  ///< TOP, ROOT, GROUP, TILE
  SectionEntry rig{};                      ///< RIG, or zeros without camera_rig

  /// Samples along a block's side: 2, 4 or 8.
  unsigned block_size() const { return 1u << block_log2; }

  /// Whether the stream uses `feature`.
  bool has(Feature feature) const { return (feature_flags & feature_bit(feature)) != 0; }

  friend bool operator==(const StreamHeader&, const StreamHeader&) = default;
};

}  // namespace hmlfc
