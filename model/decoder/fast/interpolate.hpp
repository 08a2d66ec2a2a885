// Fast interpolation of rectangles, equal to weighted_sum and its rounding on each sample (MOT-9).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "decoder/fast/reference_reader.hpp"

namespace hmlfc {

/// A displaced reference in memory. The view holds one column more than the target where fx > 0,
/// one row more where fy > 0.
struct DisplacedReference {
  ReferenceView view;
  int32_t fx = 0;  ///< [0, 7]
  int32_t fy = 0;  ///< [0, 7]
};

/// Where prediction references go: columns x rows values, row j at data + j * stride.
struct PredictionTarget {
  int16_t* data = nullptr;
  size_t stride = 0;
  unsigned columns = 0;
  unsigned rows = 0;
};

/// Writes R of MOT-9 with the first `count`, 1 or 2, of `references`, whose values lie in [-bound,
/// bound]; bound <= 8190. The target overlaps no reference.
void interpolate_rect(const std::array<DisplacedReference, 2>& references, unsigned count,
                      int32_t bound, const PredictionTarget& target);

}  // namespace hmlfc
