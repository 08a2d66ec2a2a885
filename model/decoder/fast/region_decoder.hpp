// The fast path: a rectangle of blocks of one plane, tile by tile, equal to decode_block on each.
#pragma once

#include <array>
#include <span>

#include <hmlfc/error.hpp>

#include "decoder/fast/sparse_plane.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
/// Planes that are decoded together: Y alone; Co and Cg, which share their motion.
struct PlaneGroup {
  Plane first = Plane::kY;
  size_t count = 1;  ///< 1, or 2 from kCo on

  /// Those of the group in an array by Plane.
  std::span<SamplePlane> of(std::array<SamplePlane, kPlaneCount>& planes) const {
    return std::span(planes).subspan(static_cast<size_t>(first), count);
  }
};
inline constexpr std::array<PlaneGroup, 2> kPlaneGroups{{{Plane::kY, 1}, {Plane::kCo, 2}}};

/// Adds image `image` of level `level` to `samples`, of `plane` and the planes after it that are
/// decoded together: they hold the samples of its parent in `rect` (0 at the top level; any values
/// for a key image) and afterwards its own (DEC-2, DEC-3). Shape, sources and errors as for
/// decode_region.
Result<void> add_level(const FastSources& sources, int level, ImagePos image, Plane plane,
                       const BlockRect& rect, std::span<SamplePlane> samples);

/// Decodes `rect` of `plane` and the planes after it that are decoded together, of image `image` of
/// level `level` with all its ancestors, to `samples`, one for each. These get whole blocks:
/// (bx1 - bx0) * B x (by1 - by0) * B samples; those outside the plane have no meaning. On failure
/// some block that the rectangle needs does not decode; the error need not be the first in the
/// order of CNV-7.
Result<void> decode_region(const FastSources& sources, int level, ImagePos image, Plane plane,
                           const BlockRect& rect, std::span<SamplePlane> samples);

/// Turns `samples`, of planes as for add_level, which hold the parent's in `rect`, into A of DEC-3
/// for all blocks with motion of predictive image `image` of level `level`. The stream has motion
/// tiles. On failure some block of `rect` does not decode.
Result<void> add_motion(const FastSources& sources, int level, ImagePos image, Plane plane,
                        const BlockRect& rect, std::span<SamplePlane> samples);

}  // namespace hmlfc
