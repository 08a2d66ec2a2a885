#include "io/parallel.hpp"

#include <mutex>

#include "bits/parallel.hpp"

namespace hmlfc::io {

void for_each_index(size_t count, unsigned threads, const Progress& progress,
                    const std::function<void(size_t)>& body) {
  std::mutex mutex;
  size_t done = 0;
  const ThreadLimit limit(static_cast<int>(threads));
  run_on_threads(static_cast<int>(threads), [&] {
    parallel_for(count, [&](size_t i) {
      body(i);
      if (!progress) return;
      const std::lock_guard lock(mutex);
      progress(++done, count);
    });
  });
}

}  // namespace hmlfc::io
