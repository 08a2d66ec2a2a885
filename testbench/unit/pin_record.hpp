// What stands at a unit's pins, clock by clock, for rtl/kit/pin_replay.sv.
#pragma once

#include <ostream>

#include "unit/pins.hpp"

namespace hmlfc::tb {

/// Writes a line for each clock: the inputs from this clock on, the outputs that follow from them,
/// and a mask of the outputs' bits that have a meaning, each as one hexadecimal number. The order
/// of the pins is that of the concatenations in pin_replay.sv.
class PinRecord {
 public:
  /// `out` must outlive it.
  PinRecord(std::ostream& out, const UnitParameters& unit) : out_(out), unit_(unit) {}

  void add(const UnitInputs& in, const UnitOutputs& out);

 private:
  std::ostream& out_;
  UnitParameters unit_;
};

}  // namespace hmlfc::tb
