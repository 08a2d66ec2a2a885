// The regression: random streams and sequences by seed.
#pragma once

#include <vector>

#include "stimulus/random_stream.hpp"
#include "systemc/bench.hpp"
#include "systemc/stream_image.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {

/// What one case found.
struct SuiteResult {
  ScoreCounts counts;
  std::optional<Mismatch> mismatch;
  std::vector<Request> history;  ///< the last requests
};

/// Runs `image` in a fresh unit of `maker`: directed and random requests, conditions and places in
/// memory by `seed`, a reset with requests in flight, faulty memory and its recovery, and the
/// counters. Stops at the first finding.
SuiteResult run_case(Bench& bench, const UnitMaker& maker, StreamImage& image, uint64_t seed);

}  // namespace hmlfc::tb
