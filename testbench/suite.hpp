// The regression: random streams and sequences by seed, the same for every implementation behind
// the pins.
#pragma once

#include <vector>

#include "bench.hpp"
#include "stream_image.hpp"
#include "units.hpp"

namespace hmlfc::tb {

/// How a stream is spoiled before it is loaded.
enum class Damage : uint8_t { kNone, kIndexAndTiles, kKeyImages, kHeaderField, kHeaderByte, kCut };

/// Spoils `stream`, which is intact, by `seed`. With kHeaderField the header's CRC is right again.
void spoil(std::vector<uint8_t>& stream, Damage damage, uint64_t seed);

/// The stream of case `seed`: of a random light field of either profile, with blocks of
/// `block_size`. Intact.
std::vector<uint8_t> suite_stream(uint32_t seed, unsigned block_size);

/// How the stream of case `seed` is spoiled: half of them are not.
Damage suite_damage(uint32_t seed);

/// What one case found.
struct SuiteResult {
  ScoreCounts counts;
  std::optional<Mismatch> mismatch;
  std::vector<Request> history;  ///< the last requests
};

/// Runs `image` in a fresh unit of `maker`: directed and random requests, conditions by `seed`, a
/// reset with requests in flight, faulty memory and its recovery, and the counters. Stops at the
/// first finding.
SuiteResult run_case(Bench& bench, const UnitMaker& maker, StreamImage& image, uint64_t seed);

}  // namespace hmlfc::tb
