// How fast a device decodes whole views.
#pragma once

#include <string>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// Views decoded to RGB, one submission each, the first one not counted.
struct SpeedReport {
  std::string device;
  uint64_t views = 0;
  uint64_t blocks = 0;              ///< of plane Y in them
  double seconds = 0;               ///< from the call to the pixels on the host
  std::vector<StageTime> stages{};  ///< on the device; empty where it has no timestamps
};

/// Decodes `views` views, at least 1, spread over the grid of `stream`.
Outcome<SpeedReport> measure_speed(GpuDecoder& decoder, const Device& device,
                                   const StreamView& stream, uint64_t views);

/// Of all stages together.
double device_seconds(const std::vector<StageTime>& stages);

/// A line for each stage: its milliseconds for one of `count` pieces, "view" or "frame".
std::string stage_text(const std::vector<StageTime>& stages, uint64_t count, const char* piece);

std::string to_text(const SpeedReport& report);
std::string to_json(const SpeedReport& report);

}  // namespace hmlfc::gpu
