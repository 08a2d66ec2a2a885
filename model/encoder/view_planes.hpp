// A view as three planes of whole blocks, as the encoder works on them.
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/light_field.hpp>

#include "decoder/sample_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Y, Co and Cg of one image. Each plane is as wide and high as its blocks (blocks_x * B x
/// blocks_y * B); samples outside the view repeat the nearest inside.
using ImagePlanes = std::array<SamplePlane, kPlaneCount>;

/// View (at.row, at.col) in YCoCg-R (COL-1); chroma of 4:2:0 is the mean of each 2 x 2 square,
/// halves rounded up.
ImagePlanes view_planes(const LightField& light_field, const Geometry& geometry, ImagePos at);

/// Repeats the nearest sample inside width x height over the rest of `plane`.
void extend_borders(SamplePlane& plane, uint32_t width, uint32_t height);

/// The width x height samples at the top left of `plane`.
SamplePlane cropped(const SamplePlane& plane, uint32_t width, uint32_t height);

}  // namespace hmlfc
