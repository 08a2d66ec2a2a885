// Time of the process, and of repeated work.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace hmlfc::bench {

/// Starts when constructed.
class Clock {
 public:
  double wall_seconds() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_begin_;
    return wall.count();
  }

  /// Of all threads of the process.
  double cpu_seconds() const { return cpu_now() - cpu_begin_; }

 private:
  static double cpu_now() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  std::chrono::steady_clock::time_point wall_begin_ = std::chrono::steady_clock::now();
  double cpu_begin_ = cpu_now();
};

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
