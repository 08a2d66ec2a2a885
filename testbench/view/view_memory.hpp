// The memory behind the view unit, which it reads and writes.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "stimulus/conditions.hpp"
#include "unit/address_coverage.hpp"
#include "view/sparse_bytes.hpp"
#include "view/view_pins.hpp"

namespace hmlfc::tb {

/// AXI slave with random latencies and stalls on every channel. Bursts of different IDs answer in
/// any order, beat by beat. It checks the unit's bursts and that what waits does not change. Bytes
/// up to 31 behind a place are random; reads further outside give DECERR, writes are a finding.
class ViewMemory {
 public:
  /// Addresses [begin, end): reads give SLVERR and other data, writes happen and give SLVERR.
  struct Fault {
    uint64_t begin = 0;
    uint64_t end = 0;
  };

  void start(const Conditions& conditions, uint64_t seed, unsigned beat_bytes);

  /// Sets the inputs of the memory's channels for the next clock, from what has just passed.
  void edge(const ViewInputs& in, const ViewOutputs& out, ViewInputs& next);

  SparseBytes content;
  std::optional<Fault> fault;
  uint64_t failed_writes = 0;  ///< bursts
  uint64_t bytes_read = 0;     ///< of beats
  uint64_t bytes_written = 0;  ///< with a strobe
  uint64_t write_beats = 0;
  std::string finding;  ///< the first breach of the protocol; empty for none
  std::array<AddressCoverage, size_t(PlaceKind::kCount)> coverage;  ///< of all bursts

 private:
  struct Read {
    uint64_t address;
    unsigned beats_left;
    uint64_t ready_at;
  };
  struct Beats {
    Beat data;
    uint16_t strobe;
    bool last;
  };
  struct Address {
    uint64_t address;
    unsigned beats;
  };
  struct Response {
    uint64_t ready_at;
    uint8_t value;
  };

  void check(bool holds, const char* rule);
  void check_stable(const ViewInputs& in, const ViewOutputs& out);
  void take(const ViewInputs& in, const ViewOutputs& out);
  void write_bursts();
  void show_beat(ViewInputs& next);
  void read(uint64_t address, ViewInputs& next);
  void cover(uint64_t address, uint64_t bytes);
  uint64_t later();

  Conditions conditions_;
  Random random_{0};
  unsigned beat_bytes_ = 16;
  uint64_t cycle_ = 0;
  std::deque<Read> reads_[2];  // by ID
  std::deque<Address> addresses_;
  std::deque<Beats> beats_;
  std::deque<Response> responses_;
  ViewOutputs before_;
  bool ar_waited_ = false, aw_waited_ = false, w_waited_ = false;
};

}  // namespace hmlfc::tb
