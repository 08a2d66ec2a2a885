// The options of cameras.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/camera.hpp>

#include "cli/commands.hpp"

namespace hmlfc::cli {

/// A pixel of a frame.
struct FramePixel {
  uint32_t x = 0;
  uint32_t y = 0;
};

/// Degrees that --fov may have.
inline constexpr double kLeastFov = 0.2;
inline constexpr double kGreatestFov = 126;

/// Of a path of which --frames does not tell.
inline constexpr int kPathFrames = 60;

/// The camera options of a command.
struct CameraOptions {
  Camera camera;
  std::optional<Camera> inputs;  ///< instead of all the others, which the command did not get
  std::optional<GeometrySource> geometry;  ///< else suitable_geometry()
  bool focus_at_infinity = false;
  std::optional<std::array<double, 2>> focus;  ///< the first and the last of a path of focus
  std::optional<FramePixel> focus_at;          ///< instead of a focus
  std::optional<int> aperture;
  std::string path;           ///< "", "orbit", "line", "focus" or a JSON file
  std::optional<int> frames;  ///< else kPathFrames
};

/// Adds --inputs: a camera by its inputs of CAM-3, such as pu=1.5,pv=0,pz=-2.
CLI::Option* add_inputs(CLI::App& app, const std::string& description,
                        std::function<void(const hmlfc_dut_camera&)> store);

/// Adds --camera, --focus, --focus-at and --aperture.
void add_start_camera(CLI::App& app, CameraOptions& options);

/// Adds --camera, --look-at, --fov, --size, --filter, --geometry, --focus, --focus-at, --aperture,
/// --path, --frames, --inputs and those of the light field's own geometry.
void add_camera_options(CLI::App& app, CameraOptions& options);

}  // namespace hmlfc::cli
