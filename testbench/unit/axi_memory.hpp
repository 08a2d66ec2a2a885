// The memory that a unit reads and, if it is a view unit, writes.
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "stimulus/conditions.hpp"
#include "unit/dram.hpp"
#include "unit/pins.hpp"
#include "unit/sparse_bytes.hpp"

namespace hmlfc::tb {

/// Addresses [begin, end): reads come with `response` (2 SLVERR, 3 DECERR) and random data, writes
/// happen and give SLVERR.
struct FaultyRange {
  uint64_t begin = 0;
  uint64_t end = 0;
  uint8_t response = 2;
};

/// AXI slave with random latencies and stalls on every channel. Bursts of one ID answer in their
/// order, those of different IDs in any, beat by beat. It checks the unit's bursts, and that what
/// waits does not change. Up to 31 bytes after a place are random; reads further outside give
/// DECERR, writes are a finding.
class AxiMemory {
 public:
  void set_unit(const UnitParameters& unit) { unit_ = unit; }
  void start(const Conditions& conditions, uint64_t seed);

  void set_faults(std::vector<FaultyRange> faults);

  /// Whether a beat with bytes of [begin, end) was read with an error since set_faults().
  bool has_failed(uint64_t begin, uint64_t end) const;

  /// Beats come when `dram`, which several memories may share, gives their line; null: after the
  /// latency of the conditions.
  void set_dram(Dram* dram) { dram_ = dram; }

  /// Whether bursts outlive a reset of the unit, as where the memory has a reset of its own.
  void keep_bursts_in_reset(bool keep) { keeps_bursts_ = keep; }

  /// Whether it gives no beats and no responses.
  void set_mute(bool mute) { mute_ = mute; }

  /// Called with the address and the beats of every burst of reads that is taken; null: nothing is
  /// called.
  using BurstListener = std::function<void(uint64_t address, unsigned beats)>;
  void set_burst_listener(BurstListener listener) { listener_ = std::move(listener); }

  /// A rising edge: sets the inputs of the memory's channels in `next`, from the pins before it.
  void edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next);

  SparseBytes content;
  std::string finding;         ///< the first breach of the protocol; empty for none
  uint64_t read_bursts = 0;    ///< these counts only rise, unless their reader sets them to 0
  uint64_t bytes_read = 0;     ///< of beats
  uint64_t write_beats = 0;    ///< taken
  uint64_t bytes_written = 0;  ///< with a strobe
  uint64_t failed_writes = 0;  ///< bursts

 private:
  struct Read {
    uint64_t address;     // of the next beat
    unsigned beats_left;  // [1, 256]
    uint64_t ready_at;    // first clock at which a beat may be shown
    bool ends = true;     // false: the burst goes on with the next entry
  };
  struct WriteBeat {
    Beat data;
    uint32_t strobe;
    bool last;
  };
  struct WriteAddress {
    uint64_t address;
    unsigned beats;
  };
  struct Response {
    uint64_t ready_at;
    uint8_t value;
  };

  void check(bool holds, const char* rule);
  void check_stable(const UnitInputs& in, const UnitOutputs& out);
  void reset(UnitInputs& next);
  void take_read(const UnitOutputs& out);
  void ask_dram(std::deque<Read>& reads, uint64_t address, unsigned beats);
  void take_write(const UnitInputs& in, const UnitOutputs& out);
  void write_bursts();
  void show_beat(UnitInputs& next);
  void fill_beat(uint64_t address, UnitInputs& next);
  const FaultyRange* fault_in(uint64_t begin, uint64_t bytes) const;
  uint64_t later();

  UnitParameters unit_;
  Conditions conditions_;
  Random random_{0};
  std::vector<FaultyRange> faults_;
  std::set<uint64_t> failed_;  // addresses of beats
  Dram* dram_ = nullptr;
  BurstListener listener_;
  bool keeps_bursts_ = false, mute_ = false;
  uint64_t cycle_ = 0;
  std::deque<Read> reads_[2];     // by ID
  unsigned outstanding_[2] = {};  // bursts by ID, until their last beat is taken
  std::deque<WriteAddress> addresses_;
  std::deque<WriteBeat> beats_;
  std::deque<Response> responses_;
  UnitOutputs before_;
  bool ar_waited_ = false, aw_waited_ = false, w_waited_ = false;
};

}  // namespace hmlfc::tb
