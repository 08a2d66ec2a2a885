// Frames of the GPU renderer against those of the golden renderer, and how long they take.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu_renderer.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// What the frames of a path took.
struct FramePath {
  uint64_t frames = 0;
  uint32_t width = 0;  ///< of each
  uint32_t height = 0;
  uint64_t needed = 0;              ///< blocks, NED-1
  uint64_t decoded = 0;             ///< of them
  double seconds = 0;               ///< from the call to the pixels on the host
  std::vector<StageTime> stages{};  ///< on the device
  std::optional<std::string> mismatch{};
};

/// Renders `frames` frames of `camera`, which goes from the first column of views to the last in
/// the middle row and looks straight ahead. Each must have the golden renderer's bytes, blocks and
/// error; stops at the first difference. `file` and `stream` are those that `renderer` has open.
Outcome<FramePath> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                const StreamView& stream, const Camera& camera, uint64_t frames);

/// The same frames without a comparison.
struct FrameSpeed {
  FramePath cold;  ///< nothing is held before the first of them
  FramePath warm;  ///< once more
};

/// Measures both, after a frame that makes pipelines and buffers.
Outcome<FrameSpeed> measure_frames(GpuRenderer& renderer, const StreamView& stream,
                                   const Camera& camera, uint64_t frames);

std::string to_text(const FramePath& path);

}  // namespace hmlfc::gpu
