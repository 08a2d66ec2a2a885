// The view units of this build.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "view/view_pins.hpp"

namespace hmlfc::tb {

/// One way to make a unit.
struct ViewMaker {
  UnitParameters parameters;
  std::unique_ptr<ViewUnit> (*make)(const UnitParameters& parameters, Oracle& oracle);
};

/// Whole view units; none without Verilator.
std::vector<ViewMaker> view_units();

/// The DMA with the golden model in place of the decode unit, for each block size.
std::vector<ViewMaker> view_dmas();

/// The first of `makers` that accepts streams with these parameters, or null.
inline const ViewMaker* view_unit_for(const std::vector<ViewMaker>& makers, unsigned block_log2,
                                      int depth) {
  const auto found = std::ranges::find_if(makers, [&](const ViewMaker& maker) {
    return maker.parameters.block_log2 == block_log2 &&
           depth <= static_cast<int>(maker.parameters.max_depth);
  });
  return found == makers.end() ? nullptr : &*found;
}

}  // namespace hmlfc::tb
