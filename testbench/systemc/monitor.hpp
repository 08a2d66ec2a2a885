// Watches the stream channels and the trace, and tells the scoreboard of each transfer.
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

}  // namespace hmlfc::tb
