// The vocabulary of an HMLFC stream: planes, profiles, header fields (specification, sections 2,
// 3).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hmlfc {

enum class Plane : uint8_t { kY = 0, kCo = 1, kCg = 2 };
inline constexpr int kPlaneCount = 3;
inline constexpr std::array<Plane, kPlaneCount> kPlanes{Plane::kY, Plane::kCo, Plane::kCg};

enum class Profile : uint8_t { kMain = 0, kExtended = 1 };

/// Bits of feature_flags (EXT-1).
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
};
inline constexpr unsigned kFeatureCount = 9;

/// The specification's name of `feature`.
constexpr std::string_view feature_name(Feature feature) {
  constexpr std::array<std::string_view, kFeatureCount> kNames{
      "residual_step", "motion_tiles", "subpel_vectors", "shared_disparity", "two_references",
      "chroma_motion", "lossy_keys",   "level_keys",     "balanced_groups"};
  return kNames[static_cast<size_t>(feature)];
}

/// The flag of `feature` as it stands in feature_flags.
constexpr uint32_t feature_bit(Feature feature) { return 1u << static_cast<unsigned>(feature); }

enum class ChromaFormat : uint8_t { k420 = 0, k444 = 1 };

/// States of a block (TIL-5).
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
  uint32_t type = 0;    ///< 1 TOP, 2 ROOT, 3 GROUP, 4 TILE
  uint32_t crc = 0;     ///< CRC-32C of the section
  uint64_t offset = 0;  ///< bytes from the start of the file
  uint64_t size = 0;    ///< bytes

  friend bool operator==(const SectionEntry&, const SectionEntry&) = default;
};

/// The header's fields (FIL-1); names and intervals are those of its table.
struct StreamHeader {
  Profile profile = Profile::kMain;
  uint32_t feature_flags = 0;
  uint32_t rows = 1;
  uint32_t cols = 1;
  uint32_t width = 1;
  uint32_t height = 1;
  int depth = 8;
  ChromaFormat chroma_format = ChromaFormat::k420;
  unsigned block_log2 = 2;
  int window = 16;
  uint32_t cluster_rows = 2;
  uint32_t cluster_cols = 2;
  int tree_height = 0;
  unsigned vector_precision = 0;           ///< [0, 3] (EXT-2)
  unsigned disparity_precision = 0;        ///< [vector_precision, 5]
  unsigned motion_tile_log2 = 0;           ///< [5, 7], or 0 without motion tiles
  unsigned disparity_grid_log2 = 0;        ///< [2, 5], or 0 without disparities
  int row_scale = 0;                       ///< [-127, 127], sixteenths
  std::vector<LevelEntry> levels;          ///< index = level, [0, tree_height]
  std::array<SectionEntry, 4> sections{};  ///< TOP, ROOT, GROUP, TILE

  /// Samples along a block's side: 2, 4 or 8.
  unsigned block_size() const { return 1u << block_log2; }

  bool has(Feature feature) const { return (feature_flags & feature_bit(feature)) != 0; }

  friend bool operator==(const StreamHeader&, const StreamHeader&) = default;
};

/// What the parameters of a header amount to, in the paper's terms: "hmlfc" (tree and motion),
/// "rlfc" (no motion) or "mc" (motion without a tree); "intra" where all views are key images.
std::string_view method_name(const StreamHeader& header);

}  // namespace hmlfc
