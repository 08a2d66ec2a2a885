// The minimum around a decode unit: software's register accesses, a memory without faults, a queue
// of requests. No SystemC and no checks: the unit's answers come out unchanged.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "stimulus/conditions.hpp"
#include "unit/pins.hpp"

namespace hmlfc::tb {

/// Thrown when the unit makes no progress for too long.
class UnitHangs : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One unit with one stream in memory, at addresses that the stream's bytes and the state of the
/// unit draw. An example of how software drives the unit (docs/hardware.md, "Using it").
class UnitHost {
 public:
  /// Called after every clock with the inputs from then on and the outputs that follow.
  using OnClock = std::function<void(const UnitInputs&, const UnitOutputs&)>;

  /// Holds `unit` in reset for a few clocks. `stream` and `area` (the reference area) must outlive
  /// the host.
  UnitHost(std::unique_ptr<DecodeUnit> unit, std::span<const uint8_t> stream,
           std::span<const uint8_t> area, OnClock on_clock = {});

  /// LOADs the stream; the error of STATUS, 0 for none. Throws UnitHangs.
  uint8_t load();

  /// The answers to `requests`, in their order. Throws UnitHangs.
  std::vector<Answer> answers(std::span<const Request> requests);

  /// After how many clocks without an answer, or reads of STATUS in load(), the unit hangs.
  void set_patience(uint64_t clocks) { patience_ = clocks; }

  /// From now on the memory pauses in one of four clocks, with addresses and with data, and answers
  /// are taken in three of four clocks and, every other turn of 512 clocks, in one of sixteen, so
  /// that the unit's pipelines fill. Which clocks, `seed` says.
  void set_pauses(uint64_t seed) { pauses_.emplace(seed); }

  /// Clocks since the host was made.
  uint64_t clocks() const { return clocks_; }

  /// Called with every trace record.
  std::function<void(const LevelRecord&)> on_record;

 private:
  struct Burst {
    uint64_t address;
    unsigned beats_left;
  };

  void clock();
  bool pause(unsigned permille);
  void read_channel(UnitInputs& next);
  Beat beat_at(uint64_t address) const;
  void write(uint32_t address, uint32_t value);
  uint32_t read(uint32_t address);

  std::unique_ptr<DecodeUnit> unit_;
  OnClock on_clock_;
  std::span<const uint8_t> stream_;
  std::span<const uint8_t> area_;
  uint64_t stream_base_ = 0;
  uint64_t area_base_ = 0;
  UnitInputs in_;  ///< as the unit sees them now
  UnitInputs next_;
  UnitOutputs out_;
  std::deque<Burst> bursts_;
  std::optional<Random> pauses_;
  uint64_t patience_ = 1'000'000;
  uint64_t clocks_ = 0;
};

}  // namespace hmlfc::tb
