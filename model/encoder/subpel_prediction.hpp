// Predictions between samples, as a decoder makes them (MOT-9).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <hmlfc/format.hpp>

#include "arithmetic/motion.hpp"
#include "encoder/padded_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// K0 to K3 of one image (MOT-7) in one plane.
using ReferencePlanes = std::array<const PaddedPlane*, 4>;

/// A rectangle of a plane; it may reach past the plane's right and lower border by less than a
/// motion block.
struct Area {
  int32_t x = 0;
  int32_t y = 0;
  int32_t width = 0;
  int32_t height = 0;

  int32_t samples() const { return width * height; }
};

/// I(x, y) over `area`, row by row, without gaps, into `out`: 64 times the prediction.
void interpolate(const PaddedPlane& reference, const Area& area, const SubpelVector& vector,
                 int32_t* out);

/// R(x, y) from one I (second = null) or two (MOT-9).
void combine(const int32_t* first, const int32_t* second, int32_t samples, int32_t* out);

}  // namespace hmlfc
