// The loops that run on several threads. All of them come through here, so that a build for
// ThreadSanitizer can do without oneTBB, which is not instrumented (HMLFC_PLAIN_THREADS).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hmlfc {

/// Calls body(i) once for each i in [0, count - 1], in any order, on several threads, and returns
/// when all calls have. `body` must be safe to run concurrently for different i. Loops may nest: a
/// thread that waits for an inner loop does not begin another call of the outer one. If
/// a call throws, calls not yet begun are left out and one of the exceptions is thrown again.
void parallel_for(size_t count, const std::function<void(size_t)>& body);

/// Serves a body that takes many indices at once: calls body(begin, end) for parts [begin,
/// end) that cover [0, count - 1] without overlap. Parts longer than `grain` >= 1 may be split.
void parallel_for_parts(size_t count, size_t grain,
                        const std::function<void(size_t begin, size_t end)>& body);

/// Calls `body`, whose loops use at most `threads` threads; 0: as many as there are cores.
void run_on_threads(int threads, const std::function<void()>& body);

/// While it lives, the loops of the process use at most `threads` threads, and run_on_threads() may
/// ask for that many even with fewer cores. 0: no limit.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);

 private:
  std::shared_ptr<void> limit_;
};

}  // namespace hmlfc
