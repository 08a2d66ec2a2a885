// Columns that say which samples a case is about.
#pragma once

#include <string>
#include <utility>

#include "arithmetic/widths.hpp"
#include "primitives/primitive.hpp"

namespace hmlfc::primitives {

inline Column depth_column() { return within("depth", 8, 12); }
inline Column plane_column() { return within("plane", 0, kPlaneCount - 1); }

inline Plane plane_of(const Inputs& in) { return kPlanes[size_t{in["plane"]}]; }

inline SampleRange range_of(const Inputs& in) { return sample_range(plane_of(in), in["depth"]); }

/// A sample of the plane, in [lo, hi].
inline Column sample_column(std::string name) {
  return {std::move(name), "[lo, hi]", [](const Inputs& in) {
            const SampleRange range = range_of(in);
            return Interval{range.lo, range.hi};
          }};
}

/// A residual or ref of the plane, in [-M, M]; `meaning` as of within().
inline Column residual_column(std::string name, const std::string& meaning = {}) {
  return {std::move(name), meaning.empty() ? "[-M, M]" : "[-M, M]: " + meaning,
          [](const Inputs& in) {
            const SampleRange range = range_of(in);
            return Interval{-range.bound, range.bound};
          }};
}

}  // namespace hmlfc::primitives
