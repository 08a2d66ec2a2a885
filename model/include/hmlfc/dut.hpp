// For a decoder in C++ that hmlfc_dut.h hides: this library's types as those of the C interface.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/camera.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Returns what hmlfc_dut_get_geometry reports for a stream of this header.
inline hmlfc_dut_geometry dut_geometry(const StreamHeader& header) {
  return {header.rows,
          header.cols,
          header.width,
          header.height,
          static_cast<uint32_t>(header.depth),
          static_cast<uint32_t>(header.chroma_format),
          header.block_log2,
          static_cast<uint32_t>(header.tree_height)};
}

/// The status of a function that failed with `error`: its number in annex A, [1, 27].
inline int dut_status(const Error& error) { return static_cast<int>(error.code); }

/// Returns what hmlfc_dut_error_name returns for `status`; null for a number outside annex A.
inline const char* dut_error_name(int status) {
  const bool known = status >= 0 && status < kErrorCodeCount;
  return known ? error_name(static_cast<ErrorCode>(status)).data() : nullptr;
}

/// An input of a camera under its name in CAM-3.
struct DutCameraInput {
  const char* name;                 ///< as CAM-3 has it
  double hmlfc_dut_camera::*value;  ///< its member
};

/// All inputs, in the order in which CAM-3 checks them.
inline constexpr DutCameraInput kDutCameraInputs[] = {
    {"frame_width", &hmlfc_dut_camera::frame_width},
    {"frame_height", &hmlfc_dut_camera::frame_height},
    {"focal", &hmlfc_dut_camera::focal},
    {"shear", &hmlfc_dut_camera::shear},
    {"row_pitch", &hmlfc_dut_camera::row_pitch},
    {"pu", &hmlfc_dut_camera::pu},
    {"pv", &hmlfc_dut_camera::pv},
    {"pz", &hmlfc_dut_camera::pz},
    {"qu", &hmlfc_dut_camera::qu},
    {"qv", &hmlfc_dut_camera::qv},
    {"qz", &hmlfc_dut_camera::qz},
    {"tan_half", &hmlfc_dut_camera::tan_half},
    {"focus", &hmlfc_dut_camera::focus},
    {"aperture", &hmlfc_dut_camera::aperture},
    {"filter", &hmlfc_dut_camera::filter},
    {"geometry", &hmlfc_dut_camera::geometry}};

/// A camera of defaults alone.
inline hmlfc_dut_camera default_dut_camera() {
  hmlfc_dut_camera camera{};
  for (const DutCameraInput& input : kDutCameraInputs) camera.*input.value = std::nan("");
  return camera;
}

/// The same camera for frame_record(), which checks it. A whole number that is none, or too large,
/// becomes the nearest that the type holds.
inline Camera camera_of(const hmlfc_dut_camera& dut) {
  const auto whole = [](double value, double standard) {
    return std::isnan(value) ? standard : std::clamp(std::floor(value), 0.0, 255.0);
  };
  const auto set = [](double value, auto& target) {
    if (!std::isnan(value)) target = value;
  };
  const auto set_side = [](double value, std::optional<uint32_t>& target) {
    if (!std::isnan(value)) target = static_cast<uint32_t>(std::clamp(value, 0.0, 65536.0));
  };
  Camera camera;
  set_side(dut.frame_width, camera.frame_width);
  set_side(dut.frame_height, camera.frame_height);
  set(dut.focal, camera.focal);
  set(dut.shear, camera.shear);
  set(dut.row_pitch, camera.row_pitch);
  if (!std::isnan(dut.pu)) camera.position = WorldPoint{dut.pu, dut.pv, dut.pz};
  if (!std::isnan(dut.qu)) camera.look_at = WorldPoint{dut.qu, dut.qv, dut.qz};
  set(dut.tan_half, camera.tan_half);
  set(dut.focus, camera.focus);
  camera.aperture = static_cast<int>(whole(dut.aperture, 0));
  camera.filter = static_cast<Filter>(whole(dut.filter, 2));
  camera.geometry = static_cast<GeometrySource>(whole(dut.geometry, 0));
  return camera;
}

/// What hmlfc_dut_frame_record returns for `camera` in front of a light field of this header.
inline int dut_frame_record(const hmlfc_dut_camera& camera, const StreamHeader& header,
                            int32_t record[HMLFC_DUT_RECORD_NUMBERS], const char** input) {
  const auto made = frame_record(camera_of(camera), header);
  if (!made) {
    *input = made.error().input.data();
    return 1;
  }
  std::ranges::copy(std::bit_cast<std::array<int32_t, HMLFC_DUT_RECORD_NUMBERS>>(*made), record);
  return 0;
}

/// The record of these numbers.
inline FrameRecord frame_record_of(const int32_t record[HMLFC_DUT_RECORD_NUMBERS]) {
  std::array<int32_t, HMLFC_DUT_RECORD_NUMBERS> numbers{};
  std::copy_n(record, numbers.size(), numbers.begin());
  return std::bit_cast<FrameRecord>(numbers);
}

}  // namespace hmlfc
