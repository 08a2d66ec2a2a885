// Cameras before small light fields: at all places, and at the ends of intervals.
#pragma once

#include <cstdint>
#include <functional>
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
/// infinity; every other one with geometry.
CameraCase camera_case(uint64_t seed, uint64_t number);

/// A camera at the first view of random_stream(stream), which gives that view unchanged (SMP-4).
CameraCase view_case(uint64_t stream);

/// The result of one camera.
struct CameraOutcome {
  bool refused = false;  ///< frame_record gives no record (CAM-3, REC-3)
  std::string failure;   ///< what is wrong; empty: nothing
};

/// Draws the golden frame.
CameraOutcome try_camera(const CameraCase& made);

/// The case as JSON, for readers and to run it alone.
vectors::Json describe(const CameraCase& made);

/// Runs cameras before light fields of all sizes, and records that keep to REC-2 and REC-3 but that
/// no camera has. Each drives quantities of docs/rendering.md, section 6, to an end of their
/// intervals. Computes rays, weights and taps at the corners and the middle of the frame, but no
/// samples: no stream is needed. Then vectors and disparities of section 8 alike. Calls done(name)
/// after each.
void run_frame_extremes(const std::function<void(const std::string& name)>& done);

}  // namespace hmlfc::stress
