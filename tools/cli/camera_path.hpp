// Sequences of cameras before a light field.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc::cli {

/// tan(degrees / 2) rounded to a multiple of 2^-20, so that it is the same with every library
/// (CAM-3).
double tan_half_of(double degrees);

/// `frames` cameras that look straight ahead from an ellipse around the middle of the grid, three
/// eighths of the grid wide and high to each side; all else as in `camera`.
std::vector<Camera> orbit(const Camera& camera, const StreamHeader& header, int frames);

/// `frames` cameras from the first column to the last in the middle row.
std::vector<Camera> line(const Camera& camera, const StreamHeader& header, int frames);

/// The cameras of a JSON file: an array with one object a frame, whose keys are position and
/// look_at (arrays: column, row, distance), fov (degrees), focus and aperture; what is not there is
/// as in `camera`. Failures (kInput): the file cannot be read, or is something else.
std::vector<Camera> cameras_in_file(const Camera& camera, const std::filesystem::path& file);

}  // namespace hmlfc::cli
