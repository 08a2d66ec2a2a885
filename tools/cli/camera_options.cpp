#include "cli/camera_options.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"

namespace hmlfc::cli {

namespace {

// x rounded to a multiple of 2^-20.
double on_grid(double x) { return std::floor(x * 0x1p20 + 0.5) * 0x1p-20; }

// tan(degrees / 2) as a multiple of 2^-20, so that every library gives the same (CAM-3).
double tan_half_of(double degrees) { return on_grid(std::tan(degrees / 360 * std::numbers::pi)); }

WorldPoint middle_of(const StreamHeader& header) {
  return {(header.cols - 1) / 2.0, (header.rows - 1) / 2.0, 0};
}

double distance_of(const Camera& camera) { return camera.position ? camera.position->z : 0; }

// Cameras that look straight ahead from an ellipse around the middle of the grid with radii of
// three eighths of the grid; the rest as in `camera`.
std::vector<Camera> orbit(const Camera& camera, const StreamHeader& header, int frames) {
  const WorldPoint middle = middle_of(header);
  std::vector<Camera> cameras(static_cast<size_t>(frames), camera);
  for (int k = 0; k < frames; ++k) {
    const double angle = 2 * std::numbers::pi * k / frames;
    cameras[static_cast<size_t>(k)].position = {
        middle.u + 0.375 * (header.cols - 1) * on_grid(std::cos(angle)),
        middle.v + 0.375 * (header.rows - 1) * on_grid(std::sin(angle)), distance_of(camera)};
  }
  return cameras;
}

// Cameras from the first column to the last in the middle row.
std::vector<Camera> line(const Camera& camera, const StreamHeader& header, int frames) {
  std::vector<Camera> cameras(static_cast<size_t>(frames), camera);
  for (int k = 0; k < frames; ++k) {
    const double part = frames == 1 ? 0.5 : static_cast<double>(k) / (frames - 1);
    cameras[static_cast<size_t>(k)].position = {(header.cols - 1) * part, middle_of(header).v,
                                                distance_of(camera)};
  }
  return cameras;
}

// What is wrong with one camera of a path; read_path() says where.
struct BadCamera {
  std::string what;
};

double number(const std::string& key, const nlohmann::json& value) {
  if (!value.is_number()) throw BadCamera{key + " is not a number"};
  return value.get<double>();
}

WorldPoint point(const std::string& key, const nlohmann::json& value) {
  if (value.is_array() && value.size() == 3) {
    return {number(key, value[0]), number(key, value[1]), number(key, value[2])};
  }
  throw BadCamera{key + " is not [column, row, distance]"};
}

// Sets what `json` has of `camera`.
void read_camera(const nlohmann::json& json, Camera& camera) {
  if (!json.is_object()) throw BadCamera{"not an object"};
  for (const auto& [key, value] : json.items()) {
    if (key == "position") {
      camera.position = point(key, value);
    } else if (key == "look_at") {
      camera.look_at = point(key, value);
    } else if (key == "fov") {
      camera.tan_half = tan_half_of(number(key, value));
    } else if (key == "focus") {
      camera.focus = number(key, value);
    } else if (key == "aperture") {
      if (!value.is_number_integer()) throw BadCamera{"aperture is not an integer"};
      camera.aperture = value.get<int>();
    } else {
      throw BadCamera{"unknown key " + key};
    }
  }
}

// The cameras in `file`; what it leaves out is as in `standard`.
std::vector<Camera> read_path(const std::string& file, const Camera& standard) {
  std::ifstream stream(file);
  const auto refuse = [&](const std::string& what) {
    return Failure(ExitCode::kInput, file + ": " + what);
  };
  if (!stream) throw refuse("cannot open for reading; --path takes orbit, line or a JSON file");
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_array() || json.empty()) throw refuse("not a JSON array of cameras");
  std::vector<Camera> cameras(json.size(), standard);
  for (size_t frame = 0; frame < json.size(); ++frame) {
    try {
      read_camera(json[frame], cameras[frame]);
    } catch (const BadCamera& bad) {
      throw refuse(fmt::format("frame {}: {}", frame, bad.what));
    }
  }
  return cameras;
}

void add_point(CLI::App& app, const std::string& name, std::optional<WorldPoint>& target,
               const std::string& description) {
  const auto reader = [&target](const std::string& text) {
    const auto numbers = parse_decimals(text, 2, 3);
    if (!numbers) return false;
    target = WorldPoint{(*numbers)[0], (*numbers)[1], numbers->size() == 3 ? (*numbers)[2] : 0};
    return true;
  };
  add_value(app, name, "C,R[,Z]", description,
            "column,row or column,row,distance, such as 7.5,7.5,-2", reader);
}

void add_focus(CLI::App& app, CameraOptions& options) {
  const auto reader = [&options](const std::string& text) {
    options.focus_at_infinity = text == "inf";
    if (options.focus_at_infinity) return true;
    const auto disparity = parse_decimals(text, 1, 1);
    if (!disparity || std::abs((*disparity)[0]) > 256) return false;
    options.camera.focus = (*disparity)[0];
    return true;
  };
  add_value(app, "--focus", "D|inf", "Disparity in focus, pixels per column",
            "a number in [-256, 256], or inf", reader)
      ->default_str("0");
}

// A number of the light field's geometry; frame_record checks its interval.
template <class T>
void add_number(CLI::App& app, const std::string& name, T& target, const std::string& description,
                const std::string& standard) {
  constexpr double kAny = std::numeric_limits<double>::max();
  add_decimal(app, name, "X", -kAny, kAny, description, "a number", [&target](double number) {
    target = number;
  })->default_str(standard);
}

}  // namespace

void add_camera_options(CLI::App& app, CameraOptions& options) {
  Camera& camera = options.camera;
  add_point(app, "--camera", camera.position,
            "Position of the camera (default: middle of the grid)");
  add_point(app, "--look-at", camera.look_at, "Point that it looks at (default: straight ahead)");
  add_decimal(app, "--fov", "DEGREES", 0.2, 126, "Field of view along the longer side",
              "degrees in [0.2, 126]",
              [&camera](double degrees) { camera.tan_half = tan_half_of(degrees); })
      ->default_str("a view fills the frame");
  add_sides(app, "--size", "WxH", "width x height", kMaxFrameSide, "Pixels of a frame",
            [&camera](uint32_t width, uint32_t height) {
              camera.frame_width = width;
              camera.frame_height = height;
            })
      ->default_str("the size of a view");
  add_choice(app, "--filter", camera.filter,
             {{"nearest", Filter::kNearest},
              {"bilinear", Filter::kBilinear},
              {"quadrilinear", Filter::kQuadrilinear}},
             "How views are blended")
      ->default_str("quadrilinear");
  add_focus(app, options);
  add_integer(app, "--aperture", camera.aperture, 0, kMaxAperture,
              "2^N views on each side are blended");
  app.add_option("--path", options.path, "orbit, line or a JSON file of cameras")
      ->type_name("PATH");
  add_integer(app, "--frames", options.frames, 1, 100000, "Frames of orbit and line");
  add_number(app, "--focal", camera.focal, "Focal length of the views, pixels",
             "their longer side");
  add_number(app, "--shear", camera.shear, "Disparity at infinity, pixels per column", "0");
  add_number(app, "--row-pitch", camera.row_pitch, "Distance between rows of views, columns",
             "the stream's");
}

std::vector<Camera> cameras_of(const CameraOptions& options, const StreamHeader& header) {
  Camera camera = options.camera;
  if (options.focus_at_infinity) camera.focus = camera.shear;
  if (options.path.empty()) return {camera};
  if (options.path == "orbit") return orbit(camera, header, options.frames);
  if (options.path == "line") return line(camera, header, options.frames);
  return read_path(options.path, camera);
}

}  // namespace hmlfc::cli
