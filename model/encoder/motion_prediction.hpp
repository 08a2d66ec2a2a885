// Predictions with motion, as a decoder makes them (MOT-4 to MOT-9, DEC-3).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

#include "arithmetic/motion.hpp"
#include "arithmetic/reconstruct.hpp"
#include "decoder/fast/interpolate.hpp"
#include "encoder/padded_plane.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// K0 to K3 of one image (MOT-7) in one plane.
using ReferencePlanes = std::array<const PaddedPlane*, 4>;

/// References of the motion of one predictive image, in all its planes.
struct MotionSources {
  const StreamHeader& header;
  const Geometry& geometry;
  VectorRules rules;
  ImagePos at;
  bool keyed;              ///< of the image's level
  ReferenceImages places;  ///< K0 to K3 (MOT-7)
  const DisparityGrid& grid;

  bool two_references() const { return header.has(Feature::kTwoReferences); }

  /// The palette entry of empty motion tiles (MOT-4).
  PaletteEntry default_symbol() const {
    if (!keyed) return {};
    return {static_cast<uint8_t>(two_references() ? 1 : 0), kChoiceOwn};
  }

  /// The disparity of `choice` in [1, 9] at grid block (gx, gy) (MOT-5).
  int32_t disparity(uint32_t gx, uint32_t gy, unsigned choice) const {
    const auto& move = kChoiceMoves[choice];
    const int32_t x =
        clamp(static_cast<int32_t>(gx) + move[0], 0, static_cast<int32_t>(grid.blocks_x) - 1);
    const int32_t y =
        clamp(static_cast<int32_t>(gy) + move[1], 0, static_cast<int32_t>(grid.blocks_y) - 1);
    return grid.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
  }

  /// The vector of disparity `d` into reference image Kk.
  MotionVector full_vector(size_t k, int32_t d) const {
    return disparity_vector(d, row_offset(places[k], at), col_offset(places[k], at), rules);
  }

  /// Where it leads; in a plane of half size if `halved` (MOT-8).
  SubpelVector vector(size_t k, int32_t d, bool halved) const {
    return subpel_vector(full_vector(k, d), header.vector_precision, halved);
  }

  /// Where `symbol`, whose disparity is `d` unless it has a vector, leads there.
  SubpelVector vector(size_t k, const PaletteEntry& symbol, int32_t d, bool halved) const {
    if (symbol.choice != kChoiceVector) return vector(k, d, halved);
    return subpel_vector(explicit_vector(symbol.explicit_x, symbol.explicit_y, rules),
                         header.vector_precision, halved);
  }
};

/// The palette entries worth trying, with the choices up to `choices` in [1, 9]; the first is
/// default_symbol().
std::vector<PaletteEntry> candidate_symbols(const MotionSources& sources, unsigned choices);

/// A rectangle of a plane; it may reach past the plane's right and lower border by less than a
/// motion block.
struct Area {
  int32_t x = 0;
  int32_t y = 0;
  int32_t width = 0;
  int32_t height = 0;

  int32_t samples() const { return width * height; }
};

/// Returns what `reference` holds for position (x, y) and those to the right and below, moved by
/// `vector`.
inline DisplacedReference displaced(const PaddedPlane& reference, int32_t x, int32_t y,
                                    const SubpelVector& vector) {
  return {{reference.at(x + vector.ix, y + vector.iy), static_cast<size_t>(reference.stride())},
          vector.fx,
          vector.fy};
}

/// The largest magnitude in plane `plane` of a reference image, which is a key image if `keyed`.
constexpr int32_t reference_bound(Plane plane, int depth, bool keyed) {
  const SampleRange range = sample_range(plane, depth);
  return keyed ? range.hi : range.bound;
}

/// A(x, y) of DEC-3 for every block of `plane`, in whole blocks.
/// `parent`: whole blocks, null where it is 0; `references`: of `plane`; `tiles`: of the motion
/// plane.
SamplePlane predict_plane(const MotionSources& sources, Plane plane, const SamplePlane* parent,
                          const ReferencePlanes& references, std::span<const MotionTileCode> tiles);

}  // namespace hmlfc
