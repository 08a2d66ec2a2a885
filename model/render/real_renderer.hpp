// The real frame of docs/rendering.md, section 7, in double precision: what the fixed point is
// measured against.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/renderer.hpp>

namespace hmlfc {

/// A frame without rounding.
struct RealFrame {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> inside;  ///< 1 for each pixel that is inside, row by row
  std::vector<double> samples;  ///< R, G, B of each pixel; 0 outside
};

/// The real frame of `camera`, which frame_record accepts for this light field, from views decoded
/// whole down to `stop_level`. Errors: those of Decoder::decode_view.
Result<RealFrame> render_real(const Decoder& decoder, const Camera& camera, int stop_level);

/// The bound of ERR-1 on |frame - real frame| for filter quadrilinear at pixels that are inside in
/// both, in samples of the light field's depth.
double fixed_point_bound(const Camera& camera, const StreamHeader& header);

/// The mean squared difference of a frame's samples from the real frame's, over all pixels.
double mean_squared_error(const RgbImage& frame, const RealFrame& real);

}  // namespace hmlfc
