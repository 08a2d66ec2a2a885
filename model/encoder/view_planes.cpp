#include "encoder/view_planes.hpp"

#include <algorithm>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "decoder/colour_row.hpp"

namespace hmlfc {
namespace {

// The mean of each 2 x 2 square, which ends at the plane's border where it must.
SamplePlane halved(const SamplePlane& full) {
  SamplePlane half(ceil_div(full.width, 2u), ceil_div(full.height, 2u));
  for (uint32_t y = 0; y < half.height; ++y) {
    const auto upper = full.row(2 * y);
    const auto lower = full.row(std::min(2 * y + 1, full.height - 1));
    const auto out = half.row(y);
    const auto mean = [&](uint32_t x0, uint32_t x1) {
      return static_cast<int16_t>(round_shift(upper[x0] + upper[x1] + lower[x0] + lower[x1], 2));
    };
    for (uint32_t x = 0; x < full.width / 2; ++x) out[x] = mean(2 * x, 2 * x + 1);
    if (full.width % 2 == 1) out.back() = mean(full.width - 1, full.width - 1);
  }
  return half;
}

// Repeats the nearest sample inside width x height over the rest of `plane`.
void extend_borders(SamplePlane& plane, uint32_t width, uint32_t height) {
  for (uint32_t y = 0; y < height; ++y) {
    std::ranges::fill(plane.row(y).subspan(width), plane.row(y)[width - 1]);
  }
  for (uint32_t y = height; y < plane.height; ++y) {
    std::ranges::copy(plane.row(height - 1), plane.row(y).begin());
  }
}

}  // namespace

ImagePlanes view_planes(const ViewProvider& views, const Geometry& geometry, ImagePos at) {
  const RgbImage view = views.view({at.row, at.col});
  ImagePlanes planes;
  for (SamplePlane& plane : planes) plane = SamplePlane(view.width, view.height);
  auto& [luma, orange, green] = planes;
  read_rgb(view.samples.data(), luma.samples.size(), luma.samples.data(), orange.samples.data(),
           green.samples.data());
  for (const Plane p : kPlanes) {
    SamplePlane& plane = planes[static_cast<size_t>(p)];
    const PlaneShape& shape = geometry.plane(p);
    const bool is_halved = shape.width != plane.width || shape.height != plane.height;
    if (is_halved) plane = halved(plane);
    plane = in_whole_blocks(std::move(plane), shape, geometry.block_size());
  }
  return planes;
}

SamplePlane in_whole_blocks(SamplePlane plane, const PlaneShape& shape, unsigned block_size) {
  const uint32_t width = shape.blocks_x * block_size;
  const uint32_t height = shape.blocks_y * block_size;
  if (plane.width == width && plane.height == height) return plane;
  SamplePlane blocks(width, height);
  copy_samples(plane, 0, 0, plane.width, plane.height, blocks);
  extend_borders(blocks, plane.width, plane.height);
  return blocks;
}

SamplePlane cropped(const SamplePlane& plane, uint32_t width, uint32_t height) {
  SamplePlane part(width, height);
  copy_samples(plane, 0, 0, width, height, part);
  return part;
}

ErrorSums view_error(const ViewProvider& original, ImagePos at, const ImagePlanes& planes,
                     ChromaFormat chroma) {
  const LightFieldShape& shape = original.shape();
  const Rect all{0, 0, shape.width, shape.height};
  const RgbImage decoded = rgb_picture(planes, all, chroma == ChromaFormat::k420, shape.depth);
  return measure(original.view({at.row, at.col}), decoded);
}

}  // namespace hmlfc
