// Independent pieces of work on several threads, with progress.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>

namespace hmlfc::io {

/// Called with the number of finished pieces of `total`, 1 .. total, one call at a time and in
/// rising order, from any thread. May be empty.
using Progress = std::function<void(size_t done, size_t total)>;

/// Calls body(i) once for each i in [0, count - 1], on `threads` threads (0: all cores) and in no
/// particular order; `progress` after each. `body` must be safe to run concurrently for different
/// i.
void for_each_index(size_t count, unsigned threads, const Progress& progress,
                    const std::function<void(size_t)>& body);

/// The error of the lowest index among many threads: the same in every run.
template <class Error>
class FirstError {
 public:
  /// Whether the outcome of `index` can no longer matter.
  bool makes_pointless(size_t index) const {
    const std::lock_guard lock(mutex_);
    return error_ && index > index_;
  }

  void add(size_t index, const Error& error) {
    const std::lock_guard lock(mutex_);
    if (error_ && index > index_) return;
    index_ = index;
    error_ = error;
  }

  const std::optional<Error>& error() const { return error_; }

 private:
  mutable std::mutex mutex_;
  size_t index_ = 0;
  std::optional<Error> error_;
};

}  // namespace hmlfc::io
