// Latencies of the unit, for the loosely timed model.
#pragma once

#include <array>
#include <cstdint>

#include "oracle/oracle.hpp"
#include "tlm/latency_table.hpp"

namespace hmlfc::tb {

/// Clocks, by default as rtl-clocks measures them on the unit.
struct LatencyTable {
  uint64_t load = kLoadClocks;        ///< of a LOAD
  uint64_t request = kRequestClocks;  ///< of a request, besides its level blocks
  /// Of a level block: zero, motion only, motion and residual, residual only, key image.
  std::array<uint64_t, 5> level_block = kLevelBlockClocks;
};

/// The clocks from a request to its answer.
inline uint64_t clocks_of(const ExpectedAnswer& answer, const LatencyTable& table) {
  uint64_t clocks = table.request;
  for (const auto& plane : answer.planes) {
    if (!plane) continue;
    for (const LevelRecord& level : plane->levels) {
      const size_t kind = level.key ? 4 : static_cast<size_t>(level.state());
      clocks += table.level_block[kind];
    }
  }
  return clocks;
}

}  // namespace hmlfc::tb
