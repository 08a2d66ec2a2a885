// Writes the parameters.cfg of a rig.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/hci_parameters.hpp"

namespace hmlfc::io {
namespace {

tl::unexpected<std::string> no_parameters(std::string what) {
  return tl::unexpected(std::move(what));
}

double centre(uint32_t count) { return (static_cast<double>(count) - 1) / 2; }

// What a regular rig has from each view to the next.
struct Steps {
  double position = 0;  // metres or another unit
  double shift = 0;     // pixels
};

// The steps from view 0 to the last; none: one view, or steps against the pixels' axes.
std::optional<Steps> steps_of(const Rig& rig, const LightFieldShape& shape) {
  const bool along_x = shape.cols > 1;
  const double count = (along_x ? shape.cols : shape.rows) - 1;
  const size_t axis = along_x ? 0 : 1;
  if (count == 0) return std::nullopt;
  Steps steps;
  steps.position = (rig.positions.back()[axis] - rig.positions.front()[axis]) / count;
  steps.shift = (rig.intrinsics.back()[axis + 2] - rig.intrinsics.front()[axis + 2]) / count;
  if (!(steps.position > 0) || steps.shift < 0) return std::nullopt;
  return steps;
}

bool is_near(double a, double b, double slack) { return std::abs(a - b) <= slack; }

// Why the camera of view (row, col) is not one of the grid; "" if it is.
std::string misfit(const Rig& rig, const LightFieldShape& shape, const Steps& steps, uint32_t row,
                   uint32_t col) {
  constexpr double kPixels = 1e-3;
  const size_t i = size_t{row} * shape.cols + col;
  const auto& lens = rig.intrinsics[rig.intrinsics.size() == 1 ? 0 : i];
  const auto& first = rig.positions.front();
  const double slack = steps.position * 1e-6;
  const double right = col - centre(shape.cols);
  const double down = row - centre(shape.rows);
  const bool stands = is_near(rig.positions[i][0], first[0] + col * steps.position, slack) &&
                      is_near(rig.positions[i][1], first[1] + row * steps.position, slack) &&
                      is_near(rig.positions[i][2], first[2], slack);
  if (!stands) return "does not stand on a square grid in a plane";
  if (!is_near(lens[0], rig.intrinsics[0][0], kPixels) || !is_near(lens[0], lens[1], kPixels)) {
    return "has another focal length than the first, or two";
  }
  const bool aims = is_near(lens[2], centre(shape.width) + right * steps.shift, kPixels) &&
                    is_near(lens[3], centre(shape.height) + down * steps.shift, kPixels);
  return aims ? "" : "has a principal point that no distance of focus gives";
}

}  // namespace

tl::expected<HciParameters, std::string> hci_parameters_of(const Rig& rig,
                                                           const LightFieldShape& shape) {
  constexpr std::array<double, 4> kStraight{1, 0, 0, 0};
  if (rig.intrinsics.empty()) return no_parameters("the rig does not know the intrinsics");
  for (size_t i = 0; i < rig.rotations.size(); ++i) {
    if (rig.rotations[i] != kStraight)
      return no_parameters(fmt::format("rotations[{}] turns a camera", i));
  }
  const auto steps = steps_of(rig, shape);
  if (!steps) return no_parameters("the cameras do not go to the right and down");
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      const std::string what = misfit(rig, shape, *steps, row, col);
      if (!what.empty())
        return no_parameters(fmt::format("the camera of view {},{} {}", row, col, what));
    }
  }
  constexpr double kSensor = 35;
  const double focal = rig.intrinsics.front()[0];
  const double step = steps->position * rig.metres_per_unit.value_or(1);
  HciParameters found;
  found.grid = {shape.rows, shape.cols};
  found.width = shape.width;
  found.height = shape.height;
  found.focal_length_mm = focal * kSensor / std::max(shape.width, shape.height);
  found.sensor_size_mm = kSensor;
  found.baseline_mm = step * 1000;
  found.focus_distance_m = steps->shift > 0 ? focal * step / steps->shift : 0;
  return found;
}

std::string hci_parameters_text(const HciParameters& parameters) {
  constexpr const char* kText = R"([intrinsics]
focal_length_mm = {}
image_resolution_x_px = {}
image_resolution_y_px = {}
sensor_size_mm = {}
fstop = nan

[extrinsics]
num_cams_x = {}
num_cams_y = {}
baseline_mm = {}
focus_distance_m = {}
center_cam_x_m = 0
center_cam_y_m = 0
center_cam_z_m = 0
center_cam_rx_rad = 0
center_cam_ry_rad = 0
center_cam_rz_rad = 0

[meta]
scene =
category =
date =
version =
authors =
contact =
disp_min = nan
disp_max = nan
frustum_disp_min = nan
frustum_disp_max = nan
depth_map_scale = nan
)";
  return fmt::format(kText, parameters.focal_length_mm, parameters.width, parameters.height,
                     parameters.sensor_size_mm, parameters.grid.cols, parameters.grid.rows,
                     parameters.baseline_mm, parameters.focus_distance_m);
}

}  // namespace hmlfc::io
