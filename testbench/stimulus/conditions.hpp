// What the bench draws by seed: the generator of the vectors, and how the unit is treated.
#pragma once

#include "vectors/random.hpp"

namespace hmlfc::tb {

using vectors::Random;

/// How the bench treats the unit. Probabilities are in permille for each clock.
struct Conditions {
  unsigned latency = 20;        ///< clocks from an address to its first beat, [0, 200]
  unsigned latency_jitter = 0;  ///< at most so many more, drawn for each burst
  unsigned stall = 0;           ///< no beat of read data
  unsigned address_stall = 0;   ///< no read address taken
  unsigned backpressure = 0;    ///< no answer taken
  unsigned request_gap = 0;     ///< no request offered
};

}  // namespace hmlfc::tb
