// Elapsed time and CPU time of the process.
#pragma once

#include <chrono>
#include <ctime>

namespace hmlfc {

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

}  // namespace hmlfc
