// Three decoded planes to pixels (COL-2, COL-3).
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>

#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// The samples of Co and Cg that the pixels of `rect` take (COL-3); `rect` itself where they are
/// not `halved`.
Rect chroma_rect(const Rect& rect, bool halved);

/// The pixels of `rect`: planes[0] holds its samples of Y, planes[1] and planes[2] those of
/// chroma_rect(rect, halved). Planes may be larger than that; rows beyond are not used.
RgbImage rgb_picture(const std::array<SamplePlane, kPlaneCount>& planes, const Rect& rect,
                     bool halved, int depth);

}  // namespace hmlfc
