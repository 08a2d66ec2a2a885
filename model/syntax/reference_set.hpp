// The reference images of a predictive image (MOT-7).
#pragma once

#include <array>
#include <cstdint>

#include "syntax/geometry.hpp"

namespace hmlfc {

/// K0, K1, K2 and K3 of MOT-7; they need not differ.
using ReferenceImages = std::array<ImagePos, 4>;

/// The reference images of image `at` of level `l`.
ReferenceImages reference_images(const Geometry& geometry, int l, ImagePos at);

/// What a value of reference_set stands for: one or two of K0 to K3.
struct ReferenceSet {
  unsigned count;                    ///< 1 or 2
  std::array<uint8_t, 2> reference;  ///< the second has no meaning with count 1
};

/// The references of `reference_set` in [0, 7].
constexpr ReferenceSet references_of_set(unsigned reference_set) {
  constexpr std::array<ReferenceSet, 8> kSets{{{1, {0, 0}},
                                               {2, {0, 1}},
                                               {2, {0, 2}},
                                               {1, {1, 1}},
                                               {1, {2, 2}},
                                               {2, {1, 2}},
                                               {2, {0, 3}},
                                               {1, {3, 3}}}};
  return kSets[reference_set];
}

}  // namespace hmlfc
