// Software's side of the registers.
#pragma once

#include <string>

#include "stimulus/conditions.hpp"
#include "unit/pins.hpp"

namespace hmlfc::tb {

/// Master of s_axil_*: one access at a time, address and data of a write in random order.
class RegisterMaster {
 public:
  void start_write(uint32_t address, uint32_t value);
  void start_read(uint32_t address);

  /// Whether the access started last is over.
  bool done() const { return state_ == State::kIdle; }

  /// The value read last.
  uint32_t value() const { return value_; }

  void set_seed(uint64_t seed) { random_ = Random(seed); }

  /// A rising edge: sets the inputs of the register port in `next`, from the pins before it.
  void edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next);

  std::string finding;  ///< the first response that is not OKAY; empty for none

 private:
  enum class State : uint8_t { kIdle, kWrite, kRead };

  void write_edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next);
  void read_edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next);
  bool waits();
  void end(uint8_t response);

  Random random_{0};
  State state_ = State::kIdle;
  uint32_t address_ = 0;
  uint32_t value_ = 0;
  bool address_sent_ = false;
  bool data_sent_ = false;
};

}  // namespace hmlfc::tb
