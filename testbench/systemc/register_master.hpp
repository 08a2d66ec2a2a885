// Software's side of the registers.
#pragma once

#include <optional>

#include "systemc/mismatch.hpp"
#include "systemc/wires.hpp"

namespace hmlfc::tb {

/// Master of s_axil_*: one access at a time, address and data of a write in random order.
class RegisterMaster final : public EdgeModule {
 public:
  RegisterMaster(const sc_core::sc_module_name& name, Wires& wires, Findings& findings)
      : EdgeModule(name, wires), findings_(findings) {}

  void start_write(uint32_t address, uint32_t value);
  void start_read(uint32_t address);

  /// Whether the access started last is over.
  bool done() const { return state_ == State::kIdle; }

  /// The value read last.
  uint32_t value() const { return value_; }

  void set_seed(uint64_t seed) { random_ = Random(seed); }

 protected:
  void edge() override;

 private:
  enum class State : uint8_t { kIdle, kWrite, kRead };

  void write_edge();
  void read_edge();
  void check_response(uint8_t response);

  Findings& findings_;
  Random random_{0};
  State state_ = State::kIdle;
  uint32_t address_ = 0;
  uint32_t value_ = 0;
  bool address_sent_ = false;
  bool data_sent_ = false;
};

}  // namespace hmlfc::tb
