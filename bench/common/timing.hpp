// Time of repeated work.
#pragma once

#include <algorithm>

#include "terminal/clock.hpp"

namespace hmlfc::bench {

/// The shortest CPU time of body() in at least five runs and a second of CPU time, after one run
/// that warms caches: other work on the machine can only add to it.
template <class Body>
double cpu_seconds_of(const Body& body) {
  body();
  double least = 1e9;
  double total = 0;
  for (int run = 0; run < 5 || total < 1; ++run) {
    const Clock clock;
    body();
    const double seconds = clock.cpu_seconds();
    least = std::min(least, seconds);
    total += seconds;
  }
  return least;
}

}  // namespace hmlfc::bench
