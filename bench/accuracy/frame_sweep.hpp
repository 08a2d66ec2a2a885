// Time and error of frames, for settings of the renderers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "accuracy/frame_setting.hpp"

namespace hmlfc::bench {

struct FrameSweep {
  std::filesystem::path stream;
  std::filesystem::path source;  ///< a stream that decodes to the uncompressed light field
  int frames = 1;                ///< of an orbit, beginning with an empty cache, >= 1
  uint32_t side = 256;           ///< of a square frame, pixels
  std::vector<FrameSetting> settings;
};

/// For each setting an object: setting; cpu_ms.median and cpu_ms.p95 of a frame; blocks_needed and
/// blocks_decoded, means over frames; mse.total, .stream, .filter, .fixed and largest_fixed
/// (FrameErrors) and, for filter quadrilinear, bound_fixed (ERR-1). A backend without a device:
/// setting and skipped, the reason. Errors, as text: files that do not open or decode, a level that
/// the stream does not have, settings of one filter and level whose frames differ.
tl::expected<nlohmann::ordered_json, std::string> sweep_frames(const FrameSweep& sweep);

}  // namespace hmlfc::bench
