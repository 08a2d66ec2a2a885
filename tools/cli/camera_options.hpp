// The options of cameras, and the paths that they describe.
#pragma once

#include <string>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/format.hpp>

#include "cli/commands.hpp"

namespace hmlfc::cli {

/// The camera options of a command.
struct CameraOptions {
  Camera camera;
  bool focus_at_infinity = false;
  std::string path;  ///< "", "orbit", "line" or a JSON file
  int frames = 60;
};

/// Adds --camera, --look-at, --fov, --size, --filter, --focus, --aperture, --path, --frames and
/// those of the light field's own geometry.
void add_camera_options(CLI::App& app, CameraOptions& options);

/// The camera of each frame, for a light field with this header. A JSON file holds an array with
/// one object per frame, with the keys position and look_at (arrays: column, row, distance), fov
/// (degrees), focus and aperture; missing keys take the options' values. Failures (kInput): the
/// file cannot be read, or its content is not that.
std::vector<Camera> cameras_of(const CameraOptions& options, const StreamHeader& header);

}  // namespace hmlfc::cli
