// What a check of a stream has found and measured, for people and as JSON.
#pragma once

#include <string>

#include "systemc/bench.hpp"

namespace hmlfc::tb {

/// One finished run.
struct CheckReport {
  std::string file;
  std::string unit;  ///< name of the implementation
  uint64_t seed = 0;
  std::string replay;
  ScoreCounts counts;
  StreamCounts stream;
  MemoryCounts memory;
  RunStatistics statistics;
  std::optional<Mismatch> mismatch;
  std::string folder;  ///< of the failure

  /// Sent, received, compared and unchecked agree.
  bool counts_agree() const {
    return counts.sent == counts.received + counts.dropped &&
           counts.received == counts.compared + counts.unchecked;
  }

  bool passed() const { return !mismatch && counts_agree() && counts.compared != 0; }
};

/// Several lines.
std::string to_text(const CheckReport& report);

std::string to_json(const CheckReport& report);

}  // namespace hmlfc::tb
