// Frames of the GPU renderer against those of the golden renderer, and how long they take.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/gpu/renderer.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// The frames of `camera` as it goes, in `frames` frames, from the first column of views to the
/// last, near the middle row and straight ahead. It stands between rows and columns of views, so
/// that filter quadrilinear reads four views a pixel.
Outcome<std::vector<FrameRecord>> records_of_path(const Camera& camera, const StreamHeader& header,
                                                  uint64_t frames);

/// Views that have a weight in a pixel of `records`, on average over the pixels that see some.
double mean_views(std::span<const FrameRecord> records);

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

/// Renders the frames of records_of_path(). Each must have the golden renderer's bytes, blocks and
/// error; stops at the first difference. `file` and `stream` are those that `renderer` has open.
Outcome<FramePath> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                const StreamView& stream, const Camera& camera, uint64_t frames);

/// Between four views few pixels read fewer: less means that a path lies on a row or a column.
inline constexpr double kLeastViews = 3.5;

/// The same frames without a comparison.
struct FrameSpeed {
  FramePath cold;    ///< nothing is held before the first of them
  FramePath warm;    ///< once more
  double views = 0;  ///< that have a weight in a pixel, on average
};

/// Measures both, after a frame that makes pipelines and buffers.
Outcome<FrameSpeed> measure_frames(GpuRenderer& renderer, const StreamView& stream,
                                   const Camera& camera, uint64_t frames);

std::string to_text(const FramePath& path);

}  // namespace hmlfc::gpu
