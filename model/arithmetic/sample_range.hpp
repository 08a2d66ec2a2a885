// Intervals of samples and residuals (STR-7).
#pragma once

#include <cstdint>

#include <hmlfc/format.hpp>

namespace hmlfc {

/// Samples lie in [lo, hi], residuals in [-bound, bound].
struct SampleRange {
  int32_t lo;
  int32_t hi;
  int32_t bound;  ///< M = hi - lo
};

/// The range of `plane` at `depth` in [8, 12].
///
/// Example: depth 8 gives {0, 255, 255} for Y and {-255, 255, 510} for Co and Cg.
constexpr SampleRange sample_range(Plane plane, int depth) {
  const int32_t hi = (int32_t{1} << depth) - 1;
  const int32_t lo = plane == Plane::kY ? 0 : -hi;
  return {lo, hi, hi - lo};
}

}  // namespace hmlfc
