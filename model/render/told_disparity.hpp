// Derives what the blocks of one image tell of depth (docs/rendering.md, GEO-3).
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/disparity.hpp>

#include "render/disparity_value.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// Where an image's blocks have their disparities.
enum class DisparitySource : uint8_t {
  kNone,         ///< they tell none
  kVectors,      ///< in residual tiles (TIL-7)
  kMotionTiles,  ///< in motion tiles, and in disparities of the reference image
  kShared,       ///< in disparities of the image itself, a reference image
};

/// Turns what is read of an image's blocks into what they tell.
class ToldDisparity {
 public:
  /// Serves image `image` of level `level`.
  ToldDisparity(const StreamView& stream, int level, ImagePos image);

  DisparitySource source() const { return source_; }

  /// By a shared disparity `d` in [-4096, 4095].
  BlockDisparity shared(int32_t d) const;

  /// By the palette entry of a motion tile, which the block may use, and the disparity that it
  /// shares; nothing with choice 0.
  std::optional<BlockDisparity> of_entry(const PaletteEntry& entry, int32_t disparity) const;

  /// By a vector to the reference image, in samples (TIL-7).
  BlockDisparity of_vector(int32_t dx, int32_t dy) const;

 private:
  BlockDisparity of_disparity(int32_t d, uint8_t confidence) const;
  BlockDisparity along(const Span& eighths, ImagePos reference) const;
  BlockDisparity with(int16_t disparity, uint8_t confidence) const;

  const StreamView& stream_;
  int level_;
  ImagePos image_;
  DisparitySource source_;
  int32_t cols_apart_;  // views between images of the level that are a column apart, kc
  int32_t rows_apart_;  // kr
};

}  // namespace hmlfc
