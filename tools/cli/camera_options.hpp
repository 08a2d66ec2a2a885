// The options of cameras and paths.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <hmlfc/camera.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc::cli {

/// What the command line says about the cameras of a run.
struct CameraOptions {
  Camera camera;
  bool focus_at_infinity = false;
  std::string path;  ///< "", "orbit", "line" or a JSON file
  int frames = 60;
};

/// Adds --camera, --look-at, --fov, --size, --filter, --focus, --aperture, --path, --frames and
/// those of the light field's own geometry.
void add_camera_options(CLI::App& app, CameraOptions& options);

/// The cameras of all frames before a light field of this header. Failures: those of
/// cameras_in_file.
std::vector<Camera> cameras_of(const CameraOptions& options, const StreamHeader& header);

}  // namespace hmlfc::cli
