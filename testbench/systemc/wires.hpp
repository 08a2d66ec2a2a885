// What the modules of the bench share: the pins between two rising edges, and the clock.
#pragma once

#include <cstdint>

#include <systemc>

#include "systemc/mismatch.hpp"
#include "unit/pins.hpp"

namespace hmlfc::tb {

/// The state of all pins. At an edge every module reads `in` and `out` as they were before it and
/// writes its own fields of `next`; afterwards the unit takes the edge and `next` becomes `in`.
struct Wires {
  UnitInputs in;
  UnitInputs next;
  UnitOutputs out;
  uint64_t cycle = 0;  ///< edges so far
  sc_core::sc_event edge;
};

/// A module that acts at every edge.
class EdgeModule : public sc_core::sc_module {
 public:
  EdgeModule(const sc_core::sc_module_name& name, Wires& wires)
      : sc_core::sc_module(name), wires_(wires) {
    SC_HAS_PROCESS(EdgeModule);
    SC_METHOD(edge);
    sensitive << wires_.edge;
    dont_initialize();
  }

 protected:
  /// Called once at every rising edge.
  virtual void edge() = 0;

  Wires& wires_;
};

/// `Part`, such as AxiMemory, as a module; its finding is one of the bench.
template <class Part>
class EdgePart final : public EdgeModule, public Part {
 public:
  EdgePart(const sc_core::sc_module_name& name, Wires& wires, Findings& findings)
      : EdgeModule(name, wires), findings_(findings) {}

 protected:
  void edge() override {
    Part::edge(wires_.in, wires_.out, wires_.next);
    if (Part::finding.empty()) return;
    findings_.add({Part::finding, {}, {}, {}, wires_.cycle});
    Part::finding.clear();
  }

 private:
  Findings& findings_;
};

}  // namespace hmlfc::tb
