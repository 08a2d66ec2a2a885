// What stands at a unit's pins, clock by clock, for rtl/kit/pin_replay.sv and view_pin_replay.sv.
#pragma once

#include <ostream>
#include <string>

#include "unit/pins.hpp"

namespace hmlfc::tb {

/// A line of a record: the inputs from this clock on, the outputs that follow from them, and a mask
/// of the outputs' bits that have a meaning, each as one hexadecimal number. The order of the pins
/// is that of the concatenations in the modules that play it.
class PinLine {
 public:
  explicit PinLine(bool rst_n) : on_(rst_n) { in(rst_n, 1); }

  /// The next input of `bits` bits.
  void in(uint64_t value, unsigned bits) { put(inputs_, value, bits); }

  /// The next output, which has a meaning where `valid` is and there is no reset.
  void out(bool valid, uint64_t value, unsigned bits);

  /// A beat, the higher word first.
  void in(const Beat& beat, unsigned beat_bytes);

  /// The read master and the registers, which every unit has.
  void shared(const UnitInputs& in, const UnitOutputs& out, unsigned beat_bytes);

  void write(std::ostream& stream) const;

 private:
  static void put(std::string& bits, uint64_t value, unsigned count);

  bool on_;
  std::string inputs_, values_, mask_;  // bits, from the highest on
};

/// Writes a line for each clock of a decode unit.
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
