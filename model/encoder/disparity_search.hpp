// The shared disparities of one reference group (MOT-6): found by trying them on all its images.
#pragma once

#include <cstdint>
#include <vector>

#include "arithmetic/motion.hpp"
#include "encoder/padded_plane.hpp"
#include "encoder/rate_distortion.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// An image to be predicted, and where it stands from the reference.
struct SearchTarget {
  const SamplePlane* plane = nullptr;  ///< of plane Y, at least width x height samples
  int32_t row_offset = 0;              ///< row of the reference less row of the image
  int32_t col_offset = 0;
};

/// What a search needs.
struct DisparitySearch {
  const PaddedPlane* reference = nullptr;
  std::vector<SearchTarget> targets;
  uint32_t width = 0;
  uint32_t height = 0;
  VectorRules rules;
  unsigned vector_precision = 0;
  unsigned disparity_precision = 0;
  unsigned grid_log2 = 3;
  unsigned tile_log2 = 6;
  Lambda lambda;
};

/// Disparities [lo, hi], in their units.
struct DisparityRange {
  int32_t lo = 0;
  int32_t hi = 0;
};

/// The range in which nearly all blocks find their best match, by a coarse search within [-limit,
/// limit]; and the squared error that is left, to compare rules.
struct CoarseResult {
  DisparityRange range;
  int64_t error = 0;
};
CoarseResult coarse_disparities(const DisparitySearch& search, int32_t limit);

/// One disparity for each grid block: the cheapest in D + lambda R, tile by tile, as the levels of
/// a tile bound what its blocks can say.
DisparityGrid search_disparities(const DisparitySearch& search, const DisparityRange& range);

}  // namespace hmlfc
