// The Verilated units of this build.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "oracle/oracle.hpp"
#include "unit/pins.hpp"

namespace hmlfc::tb {

/// One way to make a unit. Only a DMA needs `oracle`, which must outlive it.
struct UnitMaker {
  UnitParameters parameters;
  std::unique_ptr<Unit> (*make)(const UnitParameters& parameters, Oracle* oracle);
};

/// Decode units, one for each set of parameters; none without Verilator.
std::vector<UnitMaker> rtl_units();

/// View units.
std::vector<UnitMaker> view_units();

/// The DMA of the view unit for each block size, with the golden model as its decode unit.
std::vector<UnitMaker> view_dmas();

/// The first of `makers` that accepts streams with these parameters, or null.
inline const UnitMaker* unit_for(const std::vector<UnitMaker>& makers, unsigned block_log2,
                                 int depth) {
  const auto found = std::ranges::find_if(makers, [&](const UnitMaker& maker) {
    return maker.parameters.block_log2 == block_log2 &&
           depth <= static_cast<int>(maker.parameters.max_depth);
  });
  return found == makers.end() ? nullptr : &*found;
}

/// The first of `makers` that accepts `stream`. Without a sound header, or where none does, the
/// first of all: each must refuse it. Null where there is none.
const UnitMaker* unit_for(const std::vector<UnitMaker>& makers, std::span<const uint8_t> stream);

}  // namespace hmlfc::tb
