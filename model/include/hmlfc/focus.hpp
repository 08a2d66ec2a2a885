// Click to focus: the disparity of what a pixel of a frame shows.
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/disparity.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>

namespace hmlfc {

/// Knowledge about a pixel of a frame.
enum class PixelSight : uint8_t {
  kSurface,  ///< where the surface is that it shows
  kOutside,  ///< it lies outside the light field (RAY-6), focused at 0 or at what it shows
  kUnknown,  ///< the stream says nothing about its surroundings
};

/// The answer of focus_at.
struct FocusPoint {
  PixelSight sight = PixelSight::kUnknown;  ///< what is known
  int16_t disparity = 0;  ///< of the surface, units of 2^-8 pixels a column; 0 if there is none
  ViewPos view;           ///< the view whose blocks told it

  /// Camera::focus for the focal plane through that surface.
  double focus() const { return static_cast<double>(disparity) / kDisparityUnits; }
};

/// The surface that pixel (`x`, `y`) of the frame of `camera` shows; camera.focus does not matter.
/// The ray of the pixel is followed from disparity 0 (CAM-2): where it lies in the nearest view
/// (RAY-5) at that disparity, the median is taken of the disparities that the blocks there and the
/// eight around them have with confidence above 0 (GEO-2), the lower of two in the middle; then the
/// same at the disparity found, until it stays, at most 8 times. If it does not stay, the ray
/// passes behind an edge, and the farther of the last two holds. Where no block says anything, the
/// views next to the nearest one are asked, in the order of their distance from the ray.
///
/// For user interfaces; no frame needs it. The same on every machine. Errors: bad_request for a
/// camera that frame_record refuses with focus 0, or a pixel that is not of its frame; those of
/// block_disparity.
HMLFC_EXPORT Result<FocusPoint> focus_at(const Decoder& decoder, const Camera& camera, uint32_t x,
                                         uint32_t y);

}  // namespace hmlfc
