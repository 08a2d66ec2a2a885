// How fast a device decodes whole views and draws frames of one stream.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <hmlfc/gpu/renderer.hpp>

namespace hmlfc::bench {

struct GpuPlan {
  std::vector<uint32_t> sides = {512, 1024};  ///< of square frames, pixels
  uint64_t frames = 96;                       ///< of the camera's path, at least 1
  double seconds = 2;                         ///< of each measurement, at least
};

/// The figures of a stream: its name as `stream`; `decode`, views decoded to RGB with a call each
/// (pixels/s on the device, and to the host from the calls on; ms of a view by stage); `paths`, for
/// square frames of one size with geometry or without: the views that have a weight in a pixel, CPU
/// us of the host for a frame of the renderer's begin() and finish(), and of record(); and frames
/// that stay on the device, as many under way as may be: "cold", nothing held before each frame;
/// "moving", moving on from frames before; "warm", every block held. stage_ms is empty where the
/// device has no timestamps. frames_a_second_99 is 1 / the time that 99 % of the frames keep to.
/// Throws std::runtime_error where the device fails, a frame has an error, is not the golden
/// renderer's, or reads fewer than kLeastViews views a pixel.
nlohmann::ordered_json measure_stream(gpu::Device& device, const std::string& name,
                                      std::span<const uint8_t> file, const GpuPlan& plan);

/// CPU us of the calling thread that a frame of `records` takes, drawn by begin() and finish() with
/// as many under way as may be. All are drawn once to begin with.
double host_microseconds(gpu::GpuRenderer& renderer, std::span<const FrameRecord> records);

/// The same for frames recorded into command buffers of a program: CPU time in record() alone.
double recording_microseconds(gpu::GpuRenderer& renderer, gpu::Device& device,
                              std::span<const FrameRecord> records);

}  // namespace hmlfc::bench
