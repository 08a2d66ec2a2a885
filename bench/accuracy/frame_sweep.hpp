// Time and error of frames, for settings of the renderers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <hmlfc/camera.hpp>

namespace hmlfc::bench {

/// How frames are drawn.
struct FrameSetting {
  std::string text;  ///< as it was given
  Filter filter = Filter::kQuadrilinear;
  int levels = 1;          ///< of the tree, from the top, [1, tree_height + 1]
  size_t cache_mib = 256;  ///< kept between frames by backends cpu and gpu
  std::string backend;     ///< cpu, golden or gpu
};

/// The setting of FILTER:LEVELS:CACHE:BACKEND, such as "bilinear:4:256:cpu"; std::invalid_argument
/// where the text is not of this form.
FrameSetting parse_frame_setting(const std::string& text);

/// What to draw.
struct FrameSweep {
  std::string stream;
  std::string source;   ///< a stream that decodes to the uncompressed light field
  int frames = 1;       ///< of an orbit, from an empty cache on, >= 1
  uint32_t side = 256;  ///< of a square frame, pixels
  std::vector<FrameSetting> settings;
};

/// For each setting an object: setting; cpu_ms.median and cpu_ms.p95 of a frame; blocks_needed and
/// blocks_decoded of a frame, on average; mse.total, .stream, .filter, .fixed and largest_fixed
/// (what these are: frame_sweep.cpp) and, for filter quadrilinear, bound_fixed (ERR-1). A backend
/// without a device: setting and skipped, the reason. Throws std::runtime_error: files that do not
/// open or decode, a level that the stream does not have, settings of one filter and level whose
/// frames differ.
nlohmann::ordered_json sweep_frames(const FrameSweep& sweep);

}  // namespace hmlfc::bench
