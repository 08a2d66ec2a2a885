// Cameras from the transforms.json of NeRF, instant-ngp and nerfstudio.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include <hmlfc/rig.hpp>

#include "io/json_text.hpp"

namespace hmlfc::io {

/// The pictures that cameras are wanted for.
struct CameraPictures {
  /// File names without extension, row by row, at least one; where they are not different, each
  /// with the folder it is in: "row00/col05".
  std::vector<std::string> stems;
  uint32_t width = 1;  ///< of each, pixels
  uint32_t height = 1;
};

/// Five deep, and more in members that are not read; a rig of its own keeps to them, too.
inline constexpr JsonLimits kTransformsLimits{"a rig or transforms.json", size_t{1} << 26, 16};

/// The cameras of `pictures` in the transforms.json `json`, which has "frames". Members read, of
/// the file or of a frame:
///
///   frames[].file_path         its end, with or without extension, is one of `pictures.stems`;
///                              / and \ part folders
///   frames[].transform_matrix  3 or 4 rows of 4: camera to world; X right, Y up, Z backwards
///   fl_x, fl_y, cx, cy         pixels of a picture of w x h, from its upper left corner
///   x_fov, y_fov               field of view, degrees, where fl_x, fl_y are missing
///   camera_angle_x, _y         likewise, radians
///
/// Intrinsics are scaled from w x h to the size of `pictures`, which has that aspect; where no
/// frame has a focal length they are not known. Rotations are turned to the axes of RIG-3, the
/// world stays. Error: which member is wrong and why; also one that tells a lens other than a
/// pinhole's.
tl::expected<Rig, std::string> rig_of_transforms(const nlohmann::json& json,
                                                 const CameraPictures& pictures);

}  // namespace hmlfc::io
