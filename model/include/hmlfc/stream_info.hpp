// Facts that follow from a stream's header alone: its tree of images and its conformance level.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Reads and checks the header of the stream in `file`, the bytes of a whole file (FIL-4), without
/// opening it. Sections are checked for their place, not for their content. Errors: those of FIL-4.
HMLFC_EXPORT Result<StreamHeader> parse_header(std::span<const uint8_t> file);

/// Names what the parameters of a header amount to, in the paper's terms: "hmlfc" (tree and
/// motion), "rlfc" (no motion) or "mc" (motion without a tree); "intra" where all views are key
/// images.
HMLFC_EXPORT std::string_view method_name(const StreamHeader& header);

/// The images of one level of the tree (STR-3, STR-4).
struct LevelInfo {
  uint32_t rows = 0;        ///< of images, [1, 4096]
  uint32_t cols = 0;        ///< [1, 4096]
  uint32_t ref_rows = 1;    ///< images of a reference group, [1, 255]; 1 x 1: no motion
  uint32_t ref_cols = 1;    ///< [1, 255]
  uint64_t key_images = 0;  ///< of this level, [0, rows * cols]
};

/// Level `level` in [0, tree_height]; `header` has passed parse_header.
HMLFC_EXPORT LevelInfo level_info(const StreamHeader& header, int level);

/// How the blocks of an image are predicted.
enum class ImageKind : uint8_t {
  kKey,         ///< not at all: the image is a JPEG 2000 codestream (STR-5)
  kReference,   ///< from the parent; images of its reference group refer to it (STR-4)
  kPredictive,  ///< from the parent, or from the reference image with motion
};

/// "key", "reference" or "predictive".
constexpr std::string_view image_kind_name(ImageKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"key", "reference", "predictive"};
  return kNames[static_cast<size_t>(kind)];
}

/// An image and the one that it refers to, in the grid of its level.
struct ImageInfo {
  ImageKind kind = ImageKind::kPredictive;  ///< how it is predicted
  uint32_t ref_row =
      0;  ///< the reference image of its reference group (STR-4); its own place where
  uint32_t ref_col = 0;  ///< it is the reference image
};

/// The image at (`row`, `col`) in the grid of level `level`.
HMLFC_EXPORT ImageInfo image_info(const StreamHeader& header, int level, uint32_t row,
                                  uint32_t col);

/// The greatest values that a conformance level allows (LVL-1).
struct ConformanceLimits {
  uint32_t grid_side;    ///< rows and cols, each
  uint32_t view_side;    ///< width and height, each
  uint64_t view_pixels;  ///< width * height
  int depth;             ///< bits a sample
  int window;            ///< samples
  int tree_height;       ///< levels above the views
};

/// The table of LVL-1; index = conformance level.
inline constexpr std::array<ConformanceLimits, 4> kConformanceLimits{{
    {16, 256, 16384, 8, 31, 3},
    {64, 2048, uint64_t{1} << 21, 10, 63, 6},
    {256, 8192, uint64_t{1} << 25, 12, 127, 8},
    {kMaxGrid, kMaxSide, uint64_t{kMaxSide} * kMaxSide, 12, kMaxWindow, kMaxTreeHeight},
}};

/// The least conformance level in [0, 3] whose limits `header`, which has passed parse_header,
/// keeps (LVL-3).
HMLFC_EXPORT int conformance_level(const StreamHeader& header);

}  // namespace hmlfc
