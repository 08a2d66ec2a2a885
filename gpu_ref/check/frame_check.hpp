// Frames of the GPU renderer against those of the golden renderer, and how long they take.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fields/stream_view.hpp"
#include "gpu_renderer.hpp"

namespace hmlfc::gpu {

struct FrameReport {
  uint64_t frames = 0;
  uint32_t width = 0;  ///< of each
  uint32_t height = 0;
  uint64_t blocks = 0;              ///< needed by them, NED-1
  double seconds = 0;               ///< from the call to the pixels on the host
  std::vector<StageTime> stages{};  ///< on the device
  std::optional<std::string> mismatch;
};

/// Renders `frames` frames of `camera`, which goes from the first column of views to the last in
/// the middle row and looks straight ahead, after one that is not counted. With `compare` each must
/// have the golden renderer's bytes, blocks and error; stops at the first difference. `file` and
/// `stream` are those that `renderer` has open.
Outcome<FrameReport> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                  const StreamView& stream, const Camera& camera, uint64_t frames,
                                  bool compare);

std::string to_text(const FrameReport& report);

}  // namespace hmlfc::gpu
