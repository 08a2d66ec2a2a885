// The cameras of all frames of a command.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/disparity.hpp>

#include "cli/camera_options.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// The frames of a command.
struct CameraPath {
  std::vector<Camera> cameras;
  std::optional<double> focus{};  ///< what focus_at of the options found
};

/// The camera of each frame of `file` (docs/aiming.md). A JSON file holds an array with one object
/// per frame, with the keys position and look_at (arrays: column, row, distance), fov (degrees),
/// focus or focus_at (array: x, y), and aperture; missing keys take the options' values. focus_at
/// of the options is looked up in the first frame without a focus of its own, and holds for all
/// such frames. Failures: the JSON file cannot be read, its content is not that, or a camera of it
/// has no frame (CAM-3 to REC-3) (kInput);
/// focus_at is no pixel of the frame, or sees nothing of the light field (kUsage), or the stream
/// does not know what it sees (kInput); a corrupt stream (kCorrupt).
CameraPath cameras_of(const CameraOptions& options, const StreamFile& file);

/// The view nearest to `at`.
ViewPos nearest_view(const StreamHeader& header, const WorldPoint& at);

/// The disparities of nearly all that `map` knows, in pixels a column, the least and the greatest:
/// without one percent at each end, where a stream may be wrong. None where it knows nothing.
std::optional<std::array<double, 2>> known_range(const DisparityMap& map);

/// tan(degrees / 2) as a multiple of 2^-20, so that every library gives the same (CAM-3).
double tan_half_of(double degrees);

}  // namespace hmlfc::cli
