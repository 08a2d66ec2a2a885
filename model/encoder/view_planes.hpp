// A view as three planes of whole blocks, as the encoder works on them.
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/measure.hpp>
#include <hmlfc/view_provider.hpp>

#include "decoder/sample_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Y, Co and Cg of one image. Each plane is as wide and high as its blocks (blocks_x * B x
/// blocks_y * B); samples outside the view repeat the nearest inside.
using ImagePlanes = std::array<SamplePlane, kPlaneCount>;

/// View (at.row, at.col) in YCoCg-R (COL-1); chroma of 4:2:0 is the mean of each 2 x 2 square,
/// halves rounded up.
ImagePlanes view_planes(const ViewProvider& views, const Geometry& geometry, ImagePos at);

/// `plane`, of the size of `shape`, enlarged to whole blocks: the nearest sample inside is
/// repeated.
SamplePlane in_whole_blocks(SamplePlane plane, const PlaneShape& shape, unsigned block_size);

/// The width x height samples at the top left of `plane`.
SamplePlane cropped(const SamplePlane& plane, uint32_t width, uint32_t height);

/// The error of view `at` of `original` decoded to `planes`, in RGB as a decoder returns it.
ErrorSums view_error(const ViewProvider& original, ImagePos at, const ImagePlanes& planes,
                     ChromaFormat chroma);

}  // namespace hmlfc
