#include "cli/camera_options.hpp"

#include <cmath>
#include <limits>

#include "cli/arguments.hpp"
#include "cli/camera_path.hpp"
#include "vectors/frame_case.hpp"

namespace hmlfc::cli {

namespace {

void add_point(CLI::App& app, const std::string& name, std::optional<WorldPoint>& target,
               const std::string& description) {
  const auto reader = [&target](const std::string& text) {
    const auto numbers = parse_decimals(text, 2, 3);
    if (!numbers) return false;
    target = WorldPoint{(*numbers)[0], (*numbers)[1], numbers->size() == 3 ? (*numbers)[2] : 0};
    return true;
  };
  add_value(app, name, "X,Y[,Z]", description,
            "x,y or x,y,z: column, row and distance, such as 7.5,3,-2", reader);
}

// --focus and --focus-at.
void add_focus(CLI::App& app, CameraOptions& options, const std::string& description,
               const std::string& standard) {
  const auto reader = [&options](const std::string& text) {
    options.focus_at_infinity = text == "inf";
    if (options.focus_at_infinity) return true;
    const auto set_end = [&options](size_t end, const std::string& number) {
      const auto value = parse_decimals(number, 1, 1);
      if (value) (*options.focus)[end] = value->front();
      return value && std::abs(value->front()) <= 256;
    };
    const size_t dots = text.find("..");
    options.focus.emplace();
    return set_end(0, text.substr(0, dots)) &&
           set_end(1, dots == text.npos ? text : text.substr(dots + 2));
  };
  CLI::Option* focus =
      add_value(app, "--focus", "D|inf|D..D", description,
                "a number in [-256, 256], inf, or for --path focus two, such as -1.5..2", reader)
          ->default_str(standard);
  add_numbers<2>(app, "--focus-at", "X,Y", ',', "x,y, such as 120,80",
                 "Focus on what this pixel of the (first) frame shows",
                 [&options](const auto& n) {
                   options.focus_at = FramePixel{n[0], n[1]};
                 })
      ->excludes(focus);
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

void add_aperture(CLI::App& app, CameraOptions& options, const std::string& standard) {
  add_integer(app, "--aperture", options.aperture, 0, kMaxAperture,
              "2^N views on each side are blended")
      ->default_str(standard);
}

}  // namespace

CLI::Option* add_inputs(CLI::App& app, const std::string& description,
                        std::function<void(const hmlfc_dut_camera&)> store) {
  const auto reader = [store = std::move(store)](const std::string& text) {
    try {
      store(vectors::camera_from_words(text));
    } catch (const io::TextError& error) {
      throw CLI::ValidationError("--inputs", error.what());
    }
    return true;
  };
  return add_value(app, "--inputs", "NAME=X,...", description, "", reader);
}

void add_start_camera(CLI::App& app, CameraOptions& options) {
  add_point(app, "--camera", options.camera.position,
            "Column, row, distance of the camera (default: a view of the middle)");
  add_focus(app, options, "Disparity in focus; negative is nearer", "what the middle has");
  add_aperture(app, options, "1");
}

void add_camera_options(CLI::App& app, CameraOptions& options) {
  Camera& camera = options.camera;
  const size_t before = app.get_options().size();
  add_point(app, "--camera", camera.position,
            "Column, row, distance of the camera (default: middle of the grid)");
  add_point(app, "--look-at", camera.look_at,
            "Where it looks: column, row, distance (default: straight ahead)");
  add_decimal(app, "--fov", "DEGREES", kLeastFov, kGreatestFov,
              "Field of view along the longer side", "degrees in [0.2, 126]",
              [&camera](double degrees) { camera.tan_half = tan_half_of(degrees); })
      ->default_str("a view fills the frame");
  add_sides(app, "--size", "WxH", "width x height", kMaxFrameSide, "512x384", "Pixels of a frame",
            [&camera](uint32_t width, uint32_t height) {
              camera.frame_width = width;
              camera.frame_height = height;
            })
      ->default_str("the size of a view");
  add_choice(app, "--filter", camera.filter,
             {{"nearest", Filter::kNearest},
              {"views", Filter::kViews},
              {"quadrilinear", Filter::kQuadrilinear}},
             "How views are blended")
      ->default_str("quadrilinear");
  add_choice<std::optional<GeometrySource>>(
      app, "--geometry", options.geometry,
      {{"stream", GeometrySource::kStream}, {"plane", GeometrySource::kPlane}}, "Where things are")
      ->default_str("stream if its disparities are shared");
  add_focus(app, options, "Disparity in focus, pixels per column; negative is nearer", "0");
  add_aperture(app, options, "0, with --path focus 2");
  app.add_option("--path", options.path,
                 "orbit, line, focus (a focal stack) or a JSON file of cameras")
      ->type_name("PATH");
  add_integer(app, "--frames", options.frames, 1, 100000, "Frames of orbit, line and focus")
      ->default_str(std::to_string(kPathFrames));
  CLI::Option* inputs =
      add_inputs(app, "Instead: the camera by its inputs (CAM-3)",
                 [&options](const hmlfc_dut_camera& given) { options.inputs = camera_of(given); });
  add_number(app, "--focal", camera.focal, "Focal length of the views, pixels",
             "their longer side");
  add_number(app, "--shear", camera.shear, "Disparity at infinity, pixels per column", "0");
  add_number(app, "--row-pitch", camera.row_pitch, "Distance between rows of views, columns",
             "the stream's");
  const auto all = app.get_options();
  for (size_t i = before; i < all.size(); ++i) {
    if (all[i] != inputs) inputs->excludes(all[i]);
  }
}

}  // namespace hmlfc::cli
