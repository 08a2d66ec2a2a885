// The implementations of the unit that this build has.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "unit/pins.hpp"

namespace hmlfc::tb {

/// One way to make a unit.
struct UnitMaker {
  std::string name;  ///< "rtl" or "stand-in"
  UnitParameters parameters;
  std::unique_ptr<DecodeUnit> (*make)(const UnitParameters& parameters);
};

/// The Verilated units of this build, one for each set of parameters; none without Verilator.
std::vector<UnitMaker> rtl_units();

/// The first of `makers` that accepts streams with these parameters, or null.
inline const UnitMaker* unit_for(const std::vector<UnitMaker>& makers, unsigned block_log2,
                                 int depth) {
  const auto found = std::ranges::find_if(makers, [&](const UnitMaker& maker) {
    return maker.parameters.block_log2 == block_log2 &&
           depth <= static_cast<int>(maker.parameters.max_depth);
  });
  return found == makers.end() ? nullptr : &*found;
}

}  // namespace hmlfc::tb
