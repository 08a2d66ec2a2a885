// The view units of this build.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "unit/rtl_faults.hpp"
#include "view/view_pins.hpp"

namespace hmlfc::tb {

/// One way to make a unit.
struct ViewMaker {
  UnitParameters parameters;
  std::unique_ptr<ViewUnit> (*make)(const UnitParameters& parameters, Oracle& oracle,
                                    unsigned fault);
};

/// Whole view units; none without Verilator.
std::vector<ViewMaker> view_units();

/// The DMA with the golden model in place of the decode unit, for each block size.
std::vector<ViewMaker> view_dmas();

/// The DMA in which a fault can be switched on; with 0 none is.
ViewMaker faulty_view_dma();

/// Those of view_faults.cmake.
const std::vector<RtlFault>& view_faults();

}  // namespace hmlfc::tb
