#include "bits/parallel.hpp"

#ifdef HMLFC_PLAIN_THREADS
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <sys/mman.h>

#include <new>
#include <stdexcept>
#include <string_view>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace hmlfc {

#ifdef HMLFC_PLAIN_THREADS

namespace {

// Enough for races to show on any machine.
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
  {
    std::vector<std::jthread> helpers;
    for (size_t k = 1; k < std::min(count, loop_threads()); ++k) helpers.emplace_back(work);
    work();
  }
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

#else

namespace {

// Throws std::bad_alloc unless there is room for oneTBB's first arena and threads. Without room for
// them, oneTBB 2022 waits for a lock that it holds itself.
void check_room() {
  constexpr size_t kRoom = size_t{4} << 20;
  void* const room = ::mmap(nullptr, kRoom, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, kRoom);
}

// Runs `loop`. oneTBB says of a thread for which there is no memory that pthread_create has failed.
template <class Loop>
void with_threads(const Loop& loop) {
  static const bool checked = (check_room(), true);
  static_cast<void>(checked);
  try {
    loop();
  } catch (const std::runtime_error& error) {
    if (std::string_view(error.what()).starts_with("pthread_create")) throw std::bad_alloc();
    throw;
  }
}

}  // namespace

void parallel_for(size_t count, const std::function<void(size_t)>& body) {
  with_threads(
      [&] { tbb::this_task_arena::isolate([&] { tbb::parallel_for(size_t{0}, count, body); }); });
}

void parallel_for_parts(size_t count, size_t grain,
                        const std::function<void(size_t, size_t)>& body) {
  const tbb::blocked_range<size_t> all(0, count, grain);
  with_threads([&] {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          all, [&](const tbb::blocked_range<size_t>& part) { body(part.begin(), part.end()); });
    });
  });
}

void run_on_threads(int threads, const std::function<void()>& body) {
  with_threads([&] {
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute(body);
  });
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  limit_ = std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<size_t>(threads));
}

#endif

}  // namespace hmlfc
