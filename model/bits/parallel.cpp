#include <sys/mman.h>

#include <new>
#include <stdexcept>
#include <string_view>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "bits/parallel.hpp"

namespace hmlfc {

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

}  // namespace hmlfc
