// Watches the pins: notifies the scoreboard of each transfer and checks the channel rules.
#pragma once

#include "systemc/mismatch.hpp"
#include "systemc/scoreboard.hpp"
#include "systemc/wires.hpp"

namespace hmlfc::tb {

/// Counts of the stream channels.
struct StreamCounts {
  uint64_t answer_stalls = 0;  ///< clocks in which an answer waited for ready
  uint64_t busy = 0;           ///< clocks with a request in flight
  uint64_t first_request = 0;  ///< clock of the first request of the run
  uint64_t last_answer = 0;    ///< clock of the last answer
};

/// Watches s_request_*, m_response_* and trace_*. A beat must not change while it waits.
class StreamMonitor final : public EdgeModule {
 public:
  StreamMonitor(const sc_core::sc_module_name& name, Wires& wires, Scoreboard& scoreboard,
                Findings& findings)
      : EdgeModule(name, wires), scoreboard_(scoreboard), findings_(findings) {}

  const StreamCounts& counts() const { return counts_; }
  void clear_counts() { counts_ = {}; }

 protected:
  void edge() override;

 private:
  void watch_answer();

  Scoreboard& scoreboard_;
  Findings& findings_;
  StreamCounts counts_;
  bool waits_ = false;  // an answer waited at the edge before
  Answer waiting_;
};

/// Watches m_axi_*: bursts of full beats, INCR, at most 16, inside 4 KiB, aligned, ID 0, stable
/// while they wait, and at most UnitParameters::outstanding in flight.
class ReadMonitor final : public EdgeModule {
 public:
  ReadMonitor(const sc_core::sc_module_name& name, Wires& wires, Findings& findings,
              Coverage& coverage)
      : EdgeModule(name, wires), findings_(findings), coverage_(coverage) {}

  void set_unit(const UnitParameters& unit) { unit_ = unit; }

  /// Beats taken since clear_counts().
  uint64_t beats() const { return beats_; }
  void clear_counts() { beats_ = 0; }

 protected:
  void edge() override;

 private:
  struct Address {
    uint64_t addr;
    uint8_t len, size, burst, id;
    friend bool operator==(const Address&, const Address&) = default;
  };

  void check_address(const Address& address);
  void broken(const std::string& rule, const std::string& detail);

  Findings& findings_;
  Coverage& coverage_;
  UnitParameters unit_;
  uint64_t beats_ = 0;
  unsigned outstanding_ = 0;
  bool waits_ = false;
  Address waiting_{};
};

}  // namespace hmlfc::tb
