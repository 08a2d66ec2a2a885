// How fast a device decodes whole views and draws frames of one stream.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "gpu/host_cost.hpp"

namespace hmlfc::bench {

struct GpuPlan {
  std::vector<uint32_t> sides = {512, 1024};  ///< of square frames, pixels
  uint64_t frames = 96;                       ///< of the camera's path, at least 1
  double seconds = 2;                         ///< of each measurement, at least
};

/// Views decoded to RGB, a call each.
struct DecodeSpeed {
  uint64_t views = 0;
  uint64_t pixels = 0;                   ///< in them
  double seconds = 0;                    ///< from the calls to the pixels on the host
  std::vector<gpu::StageTime> stages{};  ///< on the device; empty where it has no timestamps
};

/// Frames that stay on the device, as many under way as may be.
struct FrameSpeed {
  std::string held;                      ///< row of kHeld
  uint64_t frames = 0;                   ///< measured
  double frames_a_second = 0;            ///< mean
  double slow_frames_a_second = 0;       ///< 1 / the time that 99 % of the frames keep to
  uint64_t needed = 0;                   ///< blocks of all frames
  uint64_t decoded = 0;                  ///< of them
  std::vector<gpu::StageTime> stages{};  ///< on the device, of all frames
};

/// Square frames of one size, with geometry or without.
struct PathSpeed {
  uint32_t side = 0;
  bool geometry = false;
  double views = 0;                  ///< that have a weight in a pixel, mean
  std::vector<FrameSpeed> speeds{};  ///< nothing held before each frame ("cold"); moving on from
                                     ///< frames before ("moving"); every block held ("warm")
  gpu::HostCost begun{};             ///< frames of GpuRenderer::begin and finish
  gpu::HostCost recorded{};          ///< frames of record()
};

struct StreamSpeed {
  std::string name;
  DecodeSpeed decode;
  std::vector<PathSpeed> paths{};
};

/// Throws std::runtime_error where the device fails, a frame has an error, is not the golden
/// renderer's, or reads fewer than kLeastViews views a pixel.
StreamSpeed measure_stream(gpu::Device& device, std::string name, std::span<const uint8_t> file,
                           const GpuPlan& plan);

/// Of all stages together.
double device_seconds(std::span<const gpu::StageTime> stages);

}  // namespace hmlfc::bench
