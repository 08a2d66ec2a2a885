// What faster settings of the renderer cost in quality.
#pragma once

#include <vector>

#include <hmlfc/camera.hpp>

#include "cli/render_backend.hpp"
#include "cli/stream_file.hpp"
#include "io/parallel.hpp"

namespace hmlfc::cli {

/// One setting, over all frames of a path.
struct SweepPoint {
  Filter filter = Filter::kQuadrilinear;
  int levels = 1;       ///< of the tree, from the top
  bool cached = false;  ///< blocks are kept between frames
  double seconds = 0;   ///< a frame, wall clock
  double psnr = 0;      ///< over RGB, against the real frame of all levels; dB
};

/// Renders `cameras` with each filter, number of levels, with and without cache, and compares with
/// the real frame (docs/rendering.md, section 7) of filter quadrilinear and all levels. Failures:
/// those of rendering.
std::vector<SweepPoint> sweep_quality(const StreamFile& file, std::vector<Camera> cameras,
                                      const BackendChoice& choice, const io::Progress& progress);

}  // namespace hmlfc::cli
