// Codes one plane of an image in profile main (TIL-1 to TIL-10).
#pragma once

#include <cstdint>

#include "encoder/decisions.hpp"
#include "encoder/padded_plane.hpp"
#include "encoder/rate_distortion.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// What is to be coded, and how.
struct MainPlaneTask {
  const Geometry& geometry;
  Plane plane;
  int depth;
  int window;
  bool both_signs;     ///< search the additive phase too
  uint32_t threshold;  ///< energy below which a block is dropped
  /// Above 0, what a bit is worth takes the place of the threshold.
  Lambda lambda;
  const SamplePlane& original;                ///< whole blocks, borders extended
  const SamplePlane* parent;                  ///< reconstructed, whole blocks; null at the top: 0
  const ReferencePlane* reference = nullptr;  ///< null in a reference image
};

/// With the threshold, each block is coded by its energy, the sum of absolute differences from the
/// parent: zero where that lies below the threshold; else motion only where that of the best match
/// does; else the cheaper of an exact residual with and without motion. With lambda, squared error
/// and bits decide between all four, and values far from the others of their block may be clipped.
EncodedPlane encode_main_plane(const MainPlaneTask& task);

}  // namespace hmlfc
