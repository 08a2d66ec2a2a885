// A frame or a disparity map of the suite: what a renderer is asked for, and what must come of it
// (vectors/README.md, frames).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/disparity.hpp>
#include <hmlfc/dut.hpp>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// A frame as it must be.
struct FrameSum {
  uint32_t width = 0;   ///< pixels
  uint32_t height = 0;  ///< pixels
  int depth = 8;
  std::string sha256;  ///< of its raw form; empty where a block that it needs does not decode
  uint64_t pixels_outside = 0;
  uint64_t blocks_needed = 0;
  uint64_t disparities_looked_up = 0;
};

/// The disparity map of a view as it must be.
struct MapSum {
  ViewPos view;
  uint32_t columns = 0;  ///< of blocks
  uint32_t rows = 0;     ///< of blocks
  std::string sha256;    ///< of its raw form; empty where it has an error
};

/// Either a frame or a map.
struct FrameCase {
  std::optional<hmlfc_dut_camera> camera;      ///< of a frame
  std::optional<std::vector<int32_t>> record;  ///< that of the camera; none where it is refused
  int stop_level = 0;                          ///< [0, tree_height]
  std::optional<FrameSum> frame;               ///< goes with `record`
  std::optional<MapSum> map;
};

/// Members camera, record, stop_level, frame and map. Reading throws TextError where they do not
/// fit together.
void visit(const Members& m, FrameCase& frame);

/// Whether a manifest, which may be anyone's, asks for a frame or map of the stream of this header.
bool is_of_stream(const FrameCase& frame, const StreamHeader& header);

/// Inputs of a camera as a JSON object by their names in CAM-3. Throws TextError.
hmlfc_dut_camera camera_from(const Json& json);

/// "pu=1.5,pv=0,pz=-2,focus=-0.25": the inputs that are no defaults, in their order. The decimals
/// have as many digits as it takes to read the same double again.
std::string camera_words(const hmlfc_dut_camera& camera);

/// The same of a camera that camera_of() would give: all inputs that are set and no defaults.
std::string camera_words(const Camera& camera);

/// The camera of such words. Throws TextError, which names the input that is wrong.
hmlfc_dut_camera camera_from_words(std::string_view words);

/// The raw form of a map: for each block, row by row, its disparity as two bytes, little-endian,
/// and its confidence as one.
std::vector<uint8_t> map_bytes(const std::vector<BlockDisparity>& blocks);

}  // namespace hmlfc::vectors
