// The orbit that rendering benchmarks draw.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <hmlfc/camera.hpp>

namespace hmlfc::bench {

/// Camera `frame` of `frames` on an ellipse around the middle of the grid, its half axes 3/8 of the
/// grid, looking straight ahead; square frames of `side` pixels. frames >= 1, side in
/// [1, kMaxFrameSide].
inline Camera orbit_camera(const StreamHeader& header, int frame, int frames, uint32_t side) {
  const double angle = 2 * std::numbers::pi * frame / frames;
  Camera camera;
  camera.frame_width = side;
  camera.frame_height = side;
  camera.position = WorldPoint{(header.cols - 1) * (0.5 + 0.375 * std::cos(angle)),
                               (header.rows - 1) * (0.5 + 0.375 * std::sin(angle)), 0};
  return camera;
}

}  // namespace hmlfc::bench
