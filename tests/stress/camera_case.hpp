// Cameras before small light fields: everywhere, and where no camera can be.
#pragma once

#include <cstdint>
#include <string>

#include <hmlfc/camera.hpp>

#include "vectors/json.hpp"

namespace hmlfc::stress {

/// A camera before the light field of random_stream(stream).
struct CameraCase {
  uint64_t stream = 0;
  Camera camera;
};

/// Camera `number` of `seed`: on, near, behind and far from the view plane, straight, grazing,
/// outside the grid, fields of view from the narrowest to the widest, focus at 0, near and at
/// infinity; one in eight has an input that is not finite or outside its interval (CAM-3).
CameraCase camera_case(uint64_t seed, uint64_t number);

/// A camera at the place of the first view of random_stream(stream), which it takes as it is
/// (SMP-4).
CameraCase view_case(uint64_t stream);

/// What a camera came to.
struct CameraOutcome {
  std::string refused;  ///< why there is no frame: the error of frame_record; empty if there is one
  std::string failure;  ///< empty, or what is wrong
  uint64_t samples_compared = 0;
  double worst_part = 0;  ///< largest error in parts of the bound
};

/// Draws the golden frame and, with filter quadrilinear, compares it with the frame in double
/// precision wherever both are inside (ERR-1); the bound counts `scale` times.
CameraOutcome try_camera(const CameraCase& made, double scale);

/// The case for people and for a run with it alone.
vectors::Json describe(const CameraCase& made);

}  // namespace hmlfc::stress
