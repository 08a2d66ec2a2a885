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

/// An image to be predicted, and its place relative to the reference.
struct SearchTarget {
  const SamplePlane* plane = nullptr;  ///< of plane Y, at least width x height samples
  int32_t row_offset = 0;              ///< row of the reference less row of the image
  int32_t col_offset = 0;
};

/// A search on all images of a reference group.
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

/// A search in plane Y by the rules of `header`: all but reference, targets and lambda.
DisparitySearch disparity_search(const StreamHeader& header);

/// The range in which nearly all blocks find their best match, by a coarse search within [-limit,
/// limit]; and the squared error that is left, to compare rules.
struct CoarseResult {
  DisparityRange range;
  int64_t error = 0;
};
CoarseResult coarse_disparities(const DisparitySearch& search, int32_t limit);

/// One disparity for each grid block: the cheapest in D + lambda R, tile by tile, as the level
/// count of a tile bounds the disparities of its blocks.
DisparityGrid search_disparities(const DisparitySearch& search, const DisparityRange& range);

/// How far the views of a light field move against each other.
struct FieldDisparity {
  DisparityRange range;  ///< in units of the header's disparity_precision
  int row_scale = 16;    ///< 16, or -16 where rows run against their parallax
};

/// Looks in the group of views in the middle of the grid, up to 12 samples per view. `header` has
/// shared_disparity.
FieldDisparity probe_disparities(const LightField& light_field, const StreamHeader& header);

}  // namespace hmlfc
