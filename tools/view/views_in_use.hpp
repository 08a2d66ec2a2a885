// Which views a frame takes its pixels from.
#pragma once

#include <array>

#include <hmlfc/camera.hpp>

namespace hmlfc::view {

/// First and last row, first and last column, of the views that the rays through the corners of the
/// frame of `record` take pixels from (RAY-3, SMP-1), and all between them. For a map on the
/// screen, in floating point; geometry may need further views.
std::array<int, 4> views_in_use(const FrameRecord& record);

}  // namespace hmlfc::view
