// What stands between the clock and a unit that says when it needs one.
#pragma once

#include <cstdint>

namespace hmlfc::tb {

/// From the first reset on, and after every second one, an edge passes only where it is needed;
/// after the others each does.
class ClockGate {
 public:
  /// Whether the rising edge that comes with these inputs and outputs of the unit passes.
  bool passes(bool rst_n, bool active) {
    if (!rst_n && ran_) stops_ = !stops_;
    ran_ = rst_n;
    const bool passes = active || !stops_;
    if (!passes) ++stopped_;
    return passes;
  }

  /// Edges that did not pass.
  uint64_t stopped() const { return stopped_; }

 private:
  bool ran_ = true;  // there was no reset at the last edge
  bool stops_ = false;
  uint64_t stopped_ = 0;
};

}  // namespace hmlfc::tb
