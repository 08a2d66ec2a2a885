// With std::thread alone: where oneTBB is not there, or is not wanted (HMLFC_PLAIN_THREADS).
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "bits/parallel.hpp"

namespace hmlfc {

namespace {

// Enough for races to show on any machine in a build for ThreadSanitizer.
constexpr int kLeastThreads = 4;

std::atomic<int> process_limit = 0;  // 0: none
thread_local int own_limit = 0;      // of run_on_threads; 0: none
thread_local int depth = 0;          // loops around the present code

// Threads of a loop that begins here: half as many for each loop around it.
size_t loop_threads() {
  int threads = std::max(kLeastThreads, static_cast<int>(std::thread::hardware_concurrency()));
  if (own_limit > 0) threads = own_limit;
  if (const int limit = process_limit; limit > 0) threads = std::min(threads, limit);
  return static_cast<size_t>(std::max(1, threads >> depth));
}

// Sets `variable` for as long as it lives.
class Scoped {
 public:
  Scoped(int& variable, int value) : variable_(variable), before_(variable) { variable = value; }
  ~Scoped() { variable_ = before_; }
  Scoped(const Scoped&) = delete;
  Scoped& operator=(const Scoped&) = delete;

 private:
  int& variable_;
  int before_;
};

}  // namespace

void parallel_for(size_t count, const std::function<void(size_t)>& body) {
  std::atomic<size_t> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  const auto work = [&, limit = own_limit, inner = depth + 1] {
    const Scoped threads(own_limit, limit);
    const Scoped nested(depth, inner);
    try {
      for (size_t i = next++; i < count; i = next++) body(i);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      error = std::current_exception();
      next = count;
    }
  };
  const size_t threads = std::min(count, loop_threads());
  std::vector<std::thread> helpers;
  helpers.reserve(threads);
  try {
    for (size_t k = 1; k < threads; ++k) helpers.emplace_back(work);
  } catch (const std::exception&) {  // there is no room for more threads: fewer do the work
  }
  work();
  for (std::thread& helper : helpers) helper.join();
  if (error) std::rethrow_exception(error);
}

void parallel_for_parts(size_t count, size_t grain,
                        const std::function<void(size_t, size_t)>& body) {
  parallel_for((count + grain - 1) / grain,
               [&](size_t part) { body(part * grain, std::min((part + 1) * grain, count)); });
}

void run_on_threads(int threads, const std::function<void()>& body) {
  const Scoped limit(own_limit, threads);
  body();
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  const int before = process_limit.exchange(threads);
  limit_ = std::shared_ptr<void>(nullptr, [before](void*) { process_limit = before; });
}

}  // namespace hmlfc
