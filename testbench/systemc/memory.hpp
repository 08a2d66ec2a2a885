// The memory behind the unit's read master.
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include "stimulus/address_space.hpp"
#include "systemc/dram.hpp"
#include "systemc/wires.hpp"

namespace hmlfc::tb {

/// Bytes at an address.
struct MemoryRegion {
  uint64_t base = 0;
  std::span<const uint8_t> bytes;
};

/// Addresses [begin, end) whose beats come with `response` (2 SLVERR, 3 DECERR) and random data.
struct FaultyRange {
  uint64_t begin = 0;
  uint64_t end = 0;
  uint8_t response = 2;
};

/// Counts of the memory.
struct MemoryCounts {
  uint64_t bursts = 0;
};

/// AXI read slave: answers bursts in their order. Bytes up to 31 beyond the end of a region are
/// random; what lies further outside gives DECERR.
class Memory final : public EdgeModule {
 public:
  Memory(const sc_core::sc_module_name& name, Wires& wires) : EdgeModule(name, wires) {}

  void set_beat_bytes(unsigned bytes) { beat_bytes_ = bytes; }
  void set_regions(std::vector<MemoryRegion> regions) { regions_ = std::move(regions); }
  void set_faults(std::vector<FaultyRange> faults);

  /// Whether a beat with bytes of [begin, end) came with an error since set_faults().
  bool has_failed(uint64_t begin, uint64_t end) const;

  /// Beats come when `dram`, which several memories may share, gives their line; null: after the
  /// latency of the conditions.
  void set_dram(Dram* dram) { dram_ = dram; }

  /// Whether bursts outlive a reset of the unit, as where the memory has a reset of its own.
  void keep_bursts_in_reset(bool keep) { keeps_bursts_ = keep; }

  void start(const Conditions& conditions, uint64_t seed);

  /// Called with the address and the beats of every burst that is taken; null: nothing is called.
  using BurstListener = std::function<void(uint64_t address, unsigned beats)>;
  void set_burst_listener(BurstListener listener) { listener_ = std::move(listener); }

  const MemoryCounts& counts() const { return counts_; }
  void clear_counts() { counts_ = {}; }

 protected:
  void edge() override;

 private:
  struct Burst {
    uint64_t address;     // of the next beat
    unsigned beats_left;  // [1, 256]
    uint64_t ready_at;    // first clock at which a beat may be shown
    bool ends = true;     // false: the burst goes on with the next entry
  };

  void take_address();
  void ask_dram(uint64_t address, unsigned beats);
  void show_beat();
  void fill(Beat& beat, uint64_t address);

  std::vector<MemoryRegion> regions_;
  std::vector<FaultyRange> faults_;
  std::set<uint64_t> failed_;  // addresses of beats
  unsigned beat_bytes_ = 16;
  Conditions conditions_;
  Random random_{0};
  Dram* dram_ = nullptr;
  std::deque<Burst> bursts_;
  bool keeps_bursts_ = false;
  MemoryCounts counts_;
  BurstListener listener_;
};

}  // namespace hmlfc::tb
