// The progress of all ways to encode, and what they report where memory is out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>

#include <hmlfc/encoder.hpp>

namespace hmlfc {

inline tl::unexpected<EncodeError> memory_is_out() {
  return tl::unexpected(
      EncodeError{"out of memory: encode fewer or smaller views, or free some memory", true});
}

/// Counts finished images and reports them, one thread at a time.
class ProgressCounter {
 public:
  /// `progress`, which may be empty, outlives the counter; `done` of `total` are finished before.
  ProgressCounter(const Progress& progress, uint64_t total, uint64_t done = 0)
      : progress_(progress), total_(total), done_(done) {}

  void add() {
    const std::scoped_lock lock(mutex_);
    done_ = std::min(done_ + 1, total_);
    if (progress_) progress_(done_, total_);
  }

  uint64_t done() const { return done_; }

 private:
  const Progress& progress_;
  uint64_t total_;
  uint64_t done_;
  std::mutex mutex_;
};

}  // namespace hmlfc
