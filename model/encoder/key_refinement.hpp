// Key images that predict the images of their group best. A key image is seen once as a view and
// many times in predictions: it is worth coding an image that differs from the view, in which noise
// is averaged out over the group and which is sharp once it is interpolated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

#include "encoder/padded_plane.hpp"
#include "encoder/rate_distortion.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {

/// An image that is predicted from the key image of its group alone or from that and another one.
struct RefinementTarget {
  ImagePlanes planes;
  ImagePos at;
  ImagePos other;                                              ///< K1 (MOT-7)
  std::array<const PaddedPlane*, kPlaneCount> other_planes{};  ///< null: K0 alone
};

/// The group of one key image.
struct KeyRefinement {
  const StreamHeader& header;
  const Geometry& geometry;
  ImagePos key;  ///< K0 of all targets
  const DisparityGrid& grid;
  std::span<const RefinementTarget> targets;
  size_t images = 0;  ///< that the targets stand for, at least their number
  std::array<Lambda, kPlaneCount> lambdas;
  std::array<int, kPlaneCount> steps;  ///< each at least 2
};

/// Makes of `key`, which is the view, an image that is nearer to the least sum of two things: what
/// is left of the images of the group (ResidualEstimate), each of their grid blocks predicted with
/// its disparity, and the squared error of `key` against the view. `steps` of SIRT, the
/// simultaneous iterative reconstruction technique of tomography, in integers.
void refine_key(const KeyRefinement& task, ImagePlanes& key);

/// The squared errors of 4x4 samples in one plane of all targets, each grid block predicted from
/// `key`, of the size of whole blocks, with its disparity.
std::vector<uint32_t> prediction_errors(const KeyRefinement& task, Plane plane,
                                        const SamplePlane& key);

}  // namespace hmlfc
