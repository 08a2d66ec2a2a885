// Independent pieces of work on several threads, with progress.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace hmlfc::io {

/// Told how many of `total` pieces are done, 1 .. total, one call at a time and in rising order,
/// from any thread. May be empty.
using Progress = std::function<void(size_t done, size_t total)>;

/// Calls body(i) once for each i in [0, count - 1], on `threads` threads (0: all cores) and in no
/// particular order; `progress` after each. `body` must be safe to run concurrently for different
/// i.
template <class Body>
void for_each_index(size_t count, unsigned threads, const Progress& progress, const Body& body) {
  std::mutex mutex;
  size_t done = 0;
  const auto one_piece = [&](size_t i) {
    body(i);
    if (!progress) return;
    const std::lock_guard lock(mutex);
    progress(++done, count);
  };
  if (threads == 0) {
    tbb::parallel_for(size_t{0}, count, one_piece);
    return;
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute([&] { tbb::parallel_for(size_t{0}, count, one_piece); });
}

}  // namespace hmlfc::io
