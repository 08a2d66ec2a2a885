// The frames and views that the GPU decoder and renderer are measured with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/gpu/decoder.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// The frames of `camera` as it goes, in `frames` frames, from the first column of views to the
/// last, near the middle row and straight ahead. It stands between rows and columns of views, so
/// that filter quadrilinear reads four views a pixel.
Outcome<std::vector<FrameRecord>> records_of_path(const Camera& camera, const StreamHeader& header,
                                                  uint64_t frames);

/// Views that have a weight in a pixel of `records`, on average over the pixels that see some.
double mean_views(std::span<const FrameRecord> records);

/// Between four views few pixels read fewer: less means that a path lies on a row or a column.
inline constexpr double kLeastViews = 3.5;

/// `views` whole views, spread over the grid; at least 1.
std::vector<PixelArea> whole_views(const StreamView& stream, uint64_t views);

}  // namespace hmlfc::gpu
