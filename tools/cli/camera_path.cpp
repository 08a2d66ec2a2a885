#include "cli/camera_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <hmlfc/focus.hpp>

#include "cli/arguments.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"

namespace hmlfc::cli {
namespace {

constexpr io::JsonLimits kPathLimits{"a camera path", size_t{1} << 26, 3};

// x rounded to a multiple of 2^-20.
double on_grid(double x) { return std::floor(x * 0x1p20 + 0.5) * 0x1p-20; }

// A frame of a path, whose focus may have to be found.
struct PathFrame {
  Camera camera;
  std::optional<FramePixel> focus_at{};
  bool has_focus = false;  // of its own
};

WorldPoint middle_of(const StreamHeader& header) {
  return {(header.cols - 1) / 2.0, (header.rows - 1) / 2.0, 0};
}

double distance_of(const Camera& camera) { return camera.position ? camera.position->z : 0; }

// Cameras that look straight ahead from an ellipse around the middle of the grid with radii of
// three eighths of the grid; the rest as in `camera`.
std::vector<PathFrame> orbit(const Camera& camera, const StreamHeader& header, int frames) {
  const WorldPoint middle = middle_of(header);
  std::vector<PathFrame> path(static_cast<size_t>(frames), PathFrame{camera});
  for (int k = 0; k < frames; ++k) {
    const double angle = 2 * std::numbers::pi * k / frames;
    path[static_cast<size_t>(k)].camera.position = {
        middle.u + 0.375 * (header.cols - 1) * on_grid(std::cos(angle)),
        middle.v + 0.375 * (header.rows - 1) * on_grid(std::sin(angle)), distance_of(camera)};
  }
  return path;
}

// Cameras from the first column to the last in the middle row.
std::vector<PathFrame> line(const Camera& camera, const StreamHeader& header, int frames) {
  std::vector<PathFrame> path(static_cast<size_t>(frames), PathFrame{camera});
  for (int k = 0; k < frames; ++k) {
    const double part = frames == 1 ? 0.5 : static_cast<double>(k) / (frames - 1);
    path[static_cast<size_t>(k)].camera.position = {(header.cols - 1) * part, middle_of(header).v,
                                                    distance_of(camera)};
  }
  return path;
}

// One camera, whose focus goes from near to far, or as --focus says.
std::vector<PathFrame> focal_stack(const CameraOptions& options, const Camera& camera,
                                   const StreamFile& file) {
  std::optional range = options.focus;
  if (!range) {
    const ViewPos view =
        nearest_view(file.header(), camera.position.value_or(middle_of(file.header())));
    range = known_range(file.value(disparity_map(file.decoder(), view)));
  }
  if (!range) {
    throw Failure(ExitCode::kInput, file.path().string() +
                                        " does not say how far away things are; add where the "
                                        "focus begins and ends, such as --focus -2..2");
  }
  const auto [first, last] = *range;
  const int frames = options.frames.value_or(kPathFrames);
  std::vector<PathFrame> path(static_cast<size_t>(frames), PathFrame{camera});
  for (int k = 0; k < frames; ++k) {
    const double part = frames == 1 ? 0.5 : static_cast<double>(k) / (frames - 1);
    path[static_cast<size_t>(k)].camera.focus = on_grid(first + (last - first) * part);
  }
  return path;
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

FramePixel pixel(const std::string& key, const nlohmann::json& value) {
  const auto is_side = [](const nlohmann::json& n) {
    return n.is_number_unsigned() && n.get<uint64_t>() < kMaxFrameSide;
  };
  if (value.is_array() && value.size() == 2 && is_side(value[0]) && is_side(value[1])) {
    return {value[0].get<uint32_t>(), value[1].get<uint32_t>()};
  }
  throw BadCamera{key + " is not [x, y], a pixel of the frame"};
}

// Sets what `json` has of `frame`.
void read_frame(const nlohmann::json& json, PathFrame& frame) {
  if (!json.is_object()) throw BadCamera{"not an object"};
  Camera& camera = frame.camera;
  for (const auto& [key, value] : json.items()) {
    if (key == "position") {
      camera.position = point(key, value);
    } else if (key == "look_at") {
      camera.look_at = point(key, value);
    } else if (key == "fov") {
      const double degrees = number(key, value);
      if (!(degrees >= kLeastFov && degrees <= kGreatestFov)) {
        throw BadCamera{
            fmt::format("fov is {}, outside [{}, {}] degrees", degrees, kLeastFov, kGreatestFov)};
      }
      camera.tan_half = tan_half_of(degrees);
    } else if (key == "focus") {
      camera.focus = number(key, value);
      frame.has_focus = true;
    } else if (key == "focus_at") {
      frame.focus_at = pixel(key, value);
    } else if (key == "aperture") {
      const bool is_int = value.is_number_integer() && value == value.get<int>();
      if (!is_int) throw BadCamera{"aperture is not an integer"};
      camera.aperture = value.get<int>();
    } else {
      throw BadCamera{"unknown key " + io::shown_json(key)};
    }
  }
  if (frame.has_focus && frame.focus_at) throw BadCamera{"has both focus and focus_at"};
}

// The frames in `file`; what it leaves out is as in `standard`.
std::vector<PathFrame> read_path(const std::string& file, const Camera& standard) {
  const auto refuse = [&](const std::string& what) {
    return Failure(ExitCode::kInput, file + ": " + what);
  };
  const auto mapped = io::map_file(file);
  if (!mapped) {
    throw Failure(mapped.error().out_of_memory ? ExitCode::kOutOfMemory : ExitCode::kInput,
                  mapped.error().message + "; --path takes orbit, line, focus or a JSON file");
  }
  const auto read = io::parse_json<nlohmann::json>(mapped->bytes(), kPathLimits);
  if (!read) throw refuse("not a JSON array of cameras: " + read.error());
  const nlohmann::json& json = *read;
  if (!json.is_array() || json.empty()) throw refuse("not a JSON array of cameras");
  std::vector<PathFrame> path(json.size(), PathFrame{standard});
  for (size_t frame = 0; frame < json.size(); ++frame) {
    try {
      read_frame(json[frame], path[frame]);
    } catch (const BadCamera& bad) {
      throw refuse(fmt::format("frame {}: {}", frame, bad.what));
    }
  }
  return path;
}

// Whether the frames come from a JSON file.
bool is_file(const std::string& path) {
  return !path.empty() && path != "orbit" && path != "line" && path != "focus";
}

std::vector<PathFrame> path_of(const CameraOptions& options, const StreamFile& file) {
  const StreamHeader& header = file.header();
  const bool stack = options.path == "focus";
  const bool range = options.focus && options.focus->front() != options.focus->back();
  if (stack ? options.focus_at || options.focus_at_infinity || (options.focus && !range) : range) {
    throw Failure(ExitCode::kUsage,
                  "a focal stack is --path focus, alone or with --focus and two disparities, such "
                  "as --focus -1.5..2");
  }
  const bool is_still = options.path.empty();
  refuse_given({{"--frames", options.frames && (is_still || is_file(options.path))}},
               is_still ? "it is for --path orbit, line or focus; without --path there is one frame"
                        : options.path + " has its own number of frames; leave it out");
  Camera camera = options.camera;
  camera.aperture = options.aperture.value_or(stack ? 2 : 0);
  camera.geometry =
      options.geometry.value_or(stack ? GeometrySource::kPlane : suitable_geometry(header));
  if (options.focus) camera.focus = options.focus->front();
  if (options.focus_at_infinity) camera.focus = camera.shear;
  if (stack) return focal_stack(options, camera, file);
  if (is_file(options.path)) return read_path(options.path, camera);
  const int frames = options.frames.value_or(kPathFrames);
  if (options.path == "orbit") return orbit(camera, header, frames);
  if (options.path == "line") return line(camera, header, frames);
  return {{camera}};
}

// Fails unless `camera`, of `frame`, takes a frame. The message has the names of options, and of
// members in `path`, a JSON file; "": there is none.
void check_camera(const Camera& camera, const StreamHeader& header, const std::string& path,
                  const std::string& frame) {
  const auto record = frame_record(camera, header);
  if (record) return;
  std::string text = record.error().message;
  if (record.error().input == "tan_half") {
    text = "with this focal length and size no view fills the frame: give --fov";
  }
  constexpr std::array<std::string_view, 16> kNames{
      "look_at",     "--look-at", "position",     "--camera", "focus",     "--focus",
      "focal ",      "--focal ",  "shear",        "--shear",  "row_pitch", "--row-pitch",
      "frame_width", "--size",    "frame_height", "--size"};
  for (size_t i = path.empty() ? 0 : 6; i < kNames.size(); i += 2) {
    const size_t at = text.find(kNames[i]);
    if (at != text.npos) text.replace(at, kNames[i].size(), kNames[i + 1]);
  }
  if (path.empty()) throw Failure(ExitCode::kUsage, frame + text);
  throw Failure(ExitCode::kInput, path + ": " + frame + text);
}

// The focus for what pixel `at` of the frame of `camera` shows; `frame` begins messages.
double focus_of(const StreamFile& file, const Camera& camera, FramePixel at,
                const std::string& frame) {
  const auto refuse = [&](ExitCode code, const std::string& what) {
    return Failure(code, fmt::format("{}focus at {},{}: {}", frame, at.x, at.y, what));
  };
  const Camera full = with_defaults(camera, file.header());
  if (at.x >= *full.frame_width || at.y >= *full.frame_height) {
    throw refuse(ExitCode::kUsage, fmt::format("not a pixel of the frame, which has {} x {}",
                                               *full.frame_width, *full.frame_height));
  }
  check_camera(full, file.header(), {}, frame);
  const FocusPoint point = file.value(focus_at(file.decoder(), full, at.x, at.y));
  switch (point.sight) {
    case PixelSight::kOutside:
      throw refuse(ExitCode::kUsage, "this pixel sees nothing of the light field; choose another");
    case PixelSight::kUnknown:
      throw refuse(ExitCode::kInput,
                   file.path().string() +
                       " does not say how far away this is; choose another pixel or a --focus "
                       "(hmlfc disparity draws what is known)");
    case PixelSight::kSurface:
      break;
  }
  return point.focus();
}

}  // namespace

ViewPos nearest_view(const StreamHeader& header, const WorldPoint& at) {
  const auto nearest = [](double place, uint32_t count) {
    return static_cast<uint32_t>(std::clamp(std::floor(place + 0.5), 0.0, count - 1.0));
  };
  return {nearest(at.v, header.rows), nearest(at.u, header.cols)};
}

std::optional<std::array<double, 2>> known_range(const DisparityMap& map) {
  std::vector<int16_t> known;
  for (const BlockDisparity& block : map.blocks) {
    if (block.confidence > 0) known.push_back(block.disparity);
  }
  if (known.empty()) return std::nullopt;
  std::ranges::sort(known);
  const size_t few = known.size() / 100;
  return {{known[few] / double{kDisparityUnits},
           known[known.size() - 1 - few] / double{kDisparityUnits}}};
}

double tan_half_of(double degrees) { return on_grid(std::tan(degrees / 360 * std::numbers::pi)); }

CameraPath cameras_of(const CameraOptions& options, const StreamFile& file) {
  if (options.inputs) {
    const auto record = frame_record(*options.inputs, file.header());
    if (!record) throw Failure(ExitCode::kUsage, "--inputs: " + record.error().message);
    return {{*options.inputs}};
  }
  const std::vector<PathFrame> path = path_of(options, file);
  CameraPath made;
  for (size_t k = 0; k < path.size(); ++k) {
    const std::string frame = path.size() == 1 ? "" : fmt::format("frame {}: ", k);
    Camera camera = path[k].camera;
    if (path[k].focus_at) {
      camera.focus = focus_of(file, camera, *path[k].focus_at, frame);
    } else if (options.focus_at && !path[k].has_focus) {
      if (!made.focus) made.focus = focus_of(file, camera, *options.focus_at, frame);
      camera.focus = *made.focus;
    }
    check_camera(camera, file.header(), is_file(options.path) ? options.path : "", frame);
    refuse_given(
        {{"--geometry stream", options.geometry == GeometrySource::kStream && camera.aperture > 0}},
        frame +
            "an aperture above 0 blends what lies in the plane of focus; take --geometry plane "
            "or an aperture of 0");
    made.cameras.push_back(camera);
  }
  return made;
}

}  // namespace hmlfc::cli
