// The shared disparities of one reference group (MOT-6): found by trying them on all its images.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/light_field.hpp>

#include "arithmetic/motion.hpp"
#include "encoder/padded_plane.hpp"
#include "encoder/rate_distortion.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// Reference that an image is predicted from, and where it is seen from the image.
struct SearchReference {
  const PaddedPlane* plane = nullptr;  ///< plane Y; null: there is none
  int32_t row_offset = 0;              ///< row of the reference less row of the image
  int32_t col_offset = 0;
};

/// An image to be predicted: from the first reference, or from both as MOT-9 says.
struct SearchTarget {
  const SamplePlane* plane = nullptr;  ///< plane Y, at least width x height samples
  SearchReference first;
  SearchReference second;
};

/// A search on all images of a reference group, in plane Y and by the rules of `header`.
struct DisparitySearch {
  explicit DisparitySearch(const StreamHeader& stream_header) : header(stream_header) {}

  const StreamHeader& header;
  std::vector<SearchTarget> targets;
  size_t images = 0;  ///< whose costs the targets stand for, at least their number
  bool keyed = true;  ///< the references are key images
  Lambda lambda;
  uint32_t rows_apart = 2;  ///< a coarse search looks at one row of blocks in so many, if not few
};

/// Disparities [lo, hi], in their units.
struct DisparityRange {
  int32_t lo = 0;
  int32_t hi = 0;
};

/// The range in which nearly all blocks find their best match, by a coarse search within [-limit,
/// limit] on a part of the rows; and the squared error that is left, to compare rules.
struct CoarseResult {
  DisparityRange range;
  int64_t error = 0;
};
CoarseResult coarse_disparities(const DisparitySearch& search, int32_t limit);

/// One disparity for each grid block: the cheapest in D + lambda R, tile by tile, as the level
/// count of a tile bounds the disparities of its blocks.
DisparityGrid search_disparities(const DisparitySearch& search, const DisparityRange& range);

}  // namespace hmlfc
