#include "cli/camera_path.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/failure.hpp"

namespace hmlfc::cli {
namespace {

// x rounded to a multiple of 2^-20.
double on_grid(double x) { return std::floor(x * 0x1p20 + 0.5) * 0x1p-20; }

WorldPoint middle_of(const StreamHeader& header) {
  return {(header.cols - 1) / 2.0, (header.rows - 1) / 2.0, 0};
}

double distance_of(const Camera& camera) { return camera.position ? camera.position->z : 0; }

class PathReader {
 public:
  explicit PathReader(const std::filesystem::path& file) : file_(file) {}

  std::vector<Camera> read(const Camera& camera) {
    std::ifstream stream(file_);
    if (!stream) throw Failure(ExitCode::kInput, file_.string() + ": cannot open for reading");
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_array() || json.empty()) {
      throw Failure(ExitCode::kInput, file_.string() + ": not a JSON array of cameras");
    }
    std::vector<Camera> cameras;
    for (frame_ = 0; frame_ < json.size(); ++frame_)
      cameras.push_back(read_one(camera, json[frame_]));
    return cameras;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Failure(ExitCode::kInput, fmt::format("{}: frame {}: {}", file_.string(), frame_, what));
  }

  double number(const std::string& key, const nlohmann::json& value) const {
    if (!value.is_number()) refuse(key + " is not a number");
    return value.get<double>();
  }

  WorldPoint point(const std::string& key, const nlohmann::json& value) const {
    if (!value.is_array() || value.size() != 3) refuse(key + " is not [column, row, distance]");
    return {number(key, value[0]), number(key, value[1]), number(key, value[2])};
  }

  Camera read_one(const Camera& standard, const nlohmann::json& json) const {
    if (!json.is_object()) refuse("not an object");
    Camera camera = standard;
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
        if (!value.is_number_integer()) refuse("aperture is not an integer");
        camera.aperture = value.get<int>();
      } else {
        refuse("unknown key " + key);
      }
    }
    return camera;
  }

  const std::filesystem::path& file_;
  size_t frame_ = 0;
};

}  // namespace

double tan_half_of(double degrees) { return on_grid(std::tan(degrees / 360 * std::numbers::pi)); }

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

std::vector<Camera> line(const Camera& camera, const StreamHeader& header, int frames) {
  std::vector<Camera> cameras(static_cast<size_t>(frames), camera);
  for (int k = 0; k < frames; ++k) {
    const double part = frames == 1 ? 0.5 : static_cast<double>(k) / (frames - 1);
    cameras[static_cast<size_t>(k)].position = {(header.cols - 1) * part, middle_of(header).v,
                                                distance_of(camera)};
  }
  return cameras;
}

std::vector<Camera> cameras_in_file(const Camera& camera, const std::filesystem::path& file) {
  return PathReader(file).read(camera);
}

}  // namespace hmlfc::cli
