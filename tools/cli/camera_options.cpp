#include "cli/camera_options.hpp"

#include <cmath>

#include "cli/arguments.hpp"
#include "cli/camera_path.hpp"

namespace hmlfc::cli {
namespace {

void add_point(CLI::App& app, const std::string& name, std::optional<WorldPoint>& target,
               const std::string& description) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_decimals(text, 2, 3);
    if (!numbers) return "column,row or column,row,distance, as 7.5,7.5,-2";
    target = WorldPoint{(*numbers)[0], (*numbers)[1], numbers->size() == 3 ? (*numbers)[2] : 0};
    return std::nullopt;
  };
  add_value(app, name, "C,R[,Z]", description, reader);
}

void add_size(CLI::App& app, Camera& camera) {
  const auto reader = [&camera](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_numbers<2>(text, 'x');
    if (!numbers || (*numbers)[0] < 1 || (*numbers)[0] > kMaxFrameSide || (*numbers)[1] < 1 ||
        (*numbers)[1] > kMaxFrameSide) {
      return fmt::format("width x height in [1, {}], as 512x512", kMaxFrameSide);
    }
    camera.frame_width = (*numbers)[0];
    camera.frame_height = (*numbers)[1];
    return std::nullopt;
  };
  add_value(app, "--size", "WxH", "Pixels of a frame", reader)->default_str("those of a view");
}

void add_fov(CLI::App& app, Camera& camera) {
  const auto reader = [&camera](const std::string& text) -> std::optional<std::string> {
    const auto degrees = parse_decimals(text, 1, 1);
    if (!degrees || (*degrees)[0] < 0.2 || (*degrees)[0] > 126) return "degrees in [0.2, 126]";
    camera.tan_half = tan_half_of((*degrees)[0]);
    return std::nullopt;
  };
  add_value(app, "--fov", "DEGREES", "Field of view of the longer side", reader)
      ->default_str("a view fills the frame");
}

void add_focus(CLI::App& app, CameraOptions& options) {
  const auto reader = [&options](const std::string& text) -> std::optional<std::string> {
    options.focus_at_infinity = text == "inf";
    if (options.focus_at_infinity) return std::nullopt;
    const auto disparity = parse_decimals(text, 1, 1);
    if (!disparity || std::abs((*disparity)[0]) > 256) return "a number in [-256, 256], or inf";
    options.camera.focus = (*disparity)[0];
    return std::nullopt;
  };
  add_value(app, "--focus", "D|inf", "Disparity in focus, pixels a column", reader)
      ->default_str("0");
}

// A number of the light field's geometry; frame_record checks its interval.
template <class T>
void add_number(CLI::App& app, const std::string& name, T& target, const std::string& description,
                const std::string& standard) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    const auto number = parse_decimals(text, 1, 1);
    if (!number) return "a number";
    target = (*number)[0];
    return std::nullopt;
  };
  add_value(app, name, "X", description, reader)->default_str(standard);
}

}  // namespace

void add_camera_options(CLI::App& app, CameraOptions& options) {
  Camera& camera = options.camera;
  add_point(app, "--camera", camera.position, "The camera's place (default: the grid's middle)");
  add_point(app, "--look-at", camera.look_at, "A point it looks at (default: straight ahead)");
  add_fov(app, camera);
  add_size(app, camera);
  add_choice(app, "--filter", camera.filter,
             {{"nearest", Filter::kNearest},
              {"bilinear", Filter::kBilinear},
              {"quadrilinear", Filter::kQuadrilinear}},
             "How views are mixed")
      ->default_str("quadrilinear");
  add_focus(app, options);
  add_integer(app, "--aperture", camera.aperture, 0, kMaxAperture,
              "2^N views to each side are mixed");
  app.add_option("--path", options.path, "orbit, line, or a JSON file of cameras")
      ->type_name("PATH");
  add_integer(app, "--frames", options.frames, 1, 100000, "Frames of orbit and line");
  add_number(app, "--focal", camera.focal, "Focal length of the views, pixels",
             "their longer side");
  add_number(app, "--shear", camera.shear, "Disparity at infinity, pixels a column", "0");
  add_number(app, "--row-pitch", camera.row_pitch, "Distance of rows of views, columns",
             "the stream's");
}

std::vector<Camera> cameras_of(const CameraOptions& options, const StreamHeader& header) {
  Camera camera = options.camera;
  if (options.focus_at_infinity) camera.focus = camera.shear;
  if (options.path.empty()) return {camera};
  if (options.path == "orbit") return orbit(camera, header, options.frames);
  if (options.path == "line") return line(camera, header, options.frames);
  return cameras_in_file(camera, options.path);
}

}  // namespace hmlfc::cli
