// The test bench: the unit between a driver, a memory, software's registers and the monitors.
#pragma once

#include <memory>
#include <optional>

#include "oracle/block_reads.hpp"
#include "systemc/driver.hpp"
#include "systemc/monitor.hpp"
#include "systemc/scoreboard.hpp"
#include "unit/axi_memory.hpp"
#include "unit/register_master.hpp"
#include "unit/registers.hpp"

namespace hmlfc::tb {

/// What lies in memory.
struct MemoryImage {
  std::span<const uint8_t> stream;
  std::span<const uint8_t> reference_area;
  uint64_t stream_base = 0x10000;  ///< a multiple of 32
  uint64_t reference_base = 0;     ///< a multiple of 128; 0: after the stream
};

/// What a run has cost.
struct RunStatistics {
  uint64_t clocks = 0;      ///< from the first request to the last answer
  uint64_t bytes_read = 0;  ///< of all beats
  double seconds = 0;       ///< of the machine's CPU
};

/// Made before the first clock of the process: SystemC's modules are made once. Units, streams and
/// sequences change. Several count the same clocks; each has a `prefix` of its own.
class Bench {
 public:
  explicit Bench(const std::string& prefix = "");

  /// Connects `unit` to the pins and resets it.
  void attach(std::unique_ptr<Unit> unit);
  Unit& unit() { return *unit_; }

  /// Until the next attach(): the trace port of the unit is ignored.
  void compare_answers_only();

  void set_image(const MemoryImage& image);

  /// From now on set_image() draws, by `seed`, new places over the whole width of addresses.
  void draw_places(uint64_t seed);

  /// From now on every image lies where the last one lay.
  void keep_places();

  /// Lets `faults` fail. From now on a request may be answered with bus_error if a beat with bytes
  /// that it depends on, by `reads`, has come with an error since.
  void begin_faults(std::vector<FaultyRange> faults, const BlockReads& reads);

  /// No read fails any more, and no answer may be bus_error.
  void end_faults();
  const MemoryImage& image() const { return image_; }

  /// Holds reset for `clocks`; requests in flight are dropped.
  void reset(unsigned clocks = 4);

  void write(uint32_t address, uint32_t value);
  uint32_t read(uint32_t address);
  uint64_t read_pair(uint32_t address);

  /// Writes the registers of the stream, LOADs it and waits; the last value of STATUS, or nothing
  /// where LOAD did not end, which is a finding.
  std::optional<uint32_t> load();

  /// Takes requests from `source` until it has no more, all are answered, there is a finding, or
  /// nothing moves any more. `oracle` must live until the next call. With `stop_after` not 0 the
  /// run ends after so many clocks with requests in flight: for a reset.
  void run(RequestSource source, Oracle& oracle, const Conditions& conditions, uint64_t seed,
           uint64_t stop_after = 0);

  /// The same by parts, for several benches at once: start(), then run_clocks() of one of them
  /// until none is busy(), then finish().
  void start(RequestSource source, Oracle& oracle, const Conditions& conditions, uint64_t seed);
  bool busy();
  void finish();

  /// Compares ID and PARAMETERS with what the unit was built for, and the registers of the stream
  /// with what load() wrote.
  void check_settings();

  /// Writes DISABLE; requests wait from then on until the next LOAD.
  void disable();

  /// Compares BLOCKS with the blocks that the answers since CLEAR took, whether the unit traces
  /// them or not, and with those that it traced.
  void check_blocks();

  /// Compares the unit's counters and its first error with what the bench saw since CLEAR and
  /// begin_counting().
  void check_counters();

  /// Writes CLEAR and begins to count anew.
  void begin_counting();

  void run_clocks(uint64_t clocks);

  Findings& findings() { return findings_; }
  Coverage& coverage() { return coverage_; }
  Scoreboard& scoreboard() { return scoreboard_; }
  AxiMemory& memory() { return memory_; }
  const StreamCounts& stream_counts() const { return monitor_.counts(); }
  const RunStatistics& statistics() const { return statistics_; }
  uint64_t cycle() const { return wires_.cycle; }

  /// Called with every trace record and answer that passes, for dumps.
  using Listener = std::function<void(const UnitOutputs&)>;
  void set_listener(Listener listener) { clock_.listener = std::move(listener); }

 private:
  // Makes the edges, and lets the unit take them.
  class Clock final : public sc_core::sc_module {
   public:
    Clock(const sc_core::sc_module_name& name, Wires& wires, std::unique_ptr<Unit>& unit);
    Listener listener;

   private:
    void tick();
    void settle();
    Wires& wires_;
    std::unique_ptr<Unit>& unit_;
    sc_core::sc_event settled_;
    sc_core::sc_time period_;
  };

  void expect_counter(const char* name, uint64_t expected, uint64_t actual);

  Wires wires_;
  Findings findings_;
  Coverage coverage_;
  std::unique_ptr<Unit> unit_;
  MemoryImage image_;
  std::optional<Random> places_;  // draws seeds of an AddressSpace
  bool keeps_places_ = false;
  Clock clock_;
  Scoreboard scoreboard_;
  StreamMonitor monitor_;
  Driver driver_;
  EdgePart<AxiMemory> memory_;
  EdgePart<RegisterMaster> registers_;
  RunStatistics statistics_;
  uint64_t moved_ = 0;     // requests, records, beats and answers of a run when busy() last looked
  uint64_t moved_at_ = 0;  // clock at which they had changed
  bool traced_ = false;    // stages are compared
};

}  // namespace hmlfc::tb
