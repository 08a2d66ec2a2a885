// A unit, its memory and software's registers, without SystemC.
#pragma once

#include <memory>
#include <string>

#include "stimulus/address_space.hpp"
#include "unit/axi_memory.hpp"
#include "unit/register_master.hpp"

namespace hmlfc::tb {

/// What every host does to its unit. The first thing that goes wrong becomes the finding; what
/// follows has no meaning.
class Host {
 public:
  /// `draw` and the unit's state decide where places in memory lie.
  Host(std::unique_ptr<Unit> unit, uint64_t draw);
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// A rising edge of the clock.
  void clock();

  /// Lets `clocks` pass.
  void idle(uint64_t clocks);

  void write(uint32_t address, uint32_t value);
  uint32_t read(uint32_t address);

  /// Keeps `what` if nothing was wrong before.
  void find(const std::string& what);
  const std::string& finding() const { return finding_; }

  AxiMemory& memory() { return memory_; }
  const AxiMemory& memory() const { return memory_; }
  UnitParameters parameters() const { return unit_->parameters(); }
  uint64_t clocks() const { return clocks_; }
  uint64_t interrupt_clocks() const { return interrupt_clocks_; }      ///< with `irq` high
  uint64_t stopped_clocks() const { return unit_->stopped_clocks(); }  ///< of the unit

 protected:
  static constexpr uint64_t kAlignment = 16;  ///< of destinations

  /// Holds the unit in reset for a few clocks.
  void reset_unit();

  /// The address of a new place of at least `bytes` in memory: a multiple of `alignment`, with
  /// `behind` addresses after the place.
  uint64_t take_place(uint64_t bytes, uint64_t alignment, uint64_t behind);
  uint64_t take_stream_place(uint64_t bytes) {
    const unsigned beat_bytes = parameters().beat_bytes;
    return take_place(bytes, AddressSpace::stream_alignment(beat_bytes),
                      AddressSpace::read_behind(beat_bytes));
  }

  UnitInputs in_;    ///< as the unit has them now
  UnitInputs next_;  ///< as it has them from the next clock on
  UnitOutputs out_;
  AddressSpace space_;

 private:
  bool finish_access();

  std::unique_ptr<Unit> unit_;
  AxiMemory memory_;
  RegisterMaster registers_;
  std::string finding_;
  uint64_t clocks_ = 0;
  uint64_t interrupt_clocks_ = 0;
};

}  // namespace hmlfc::tb
