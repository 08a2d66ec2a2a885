// Independent pieces of work on several threads, with progress.
#pragma once

#include <cstddef>
#include <functional>

namespace hmlfc::io {

/// Called with the number of finished pieces of `total`, 1 .. total, one call at a time and in
/// rising order, from any thread. May be empty.
using Progress = std::function<void(size_t done, size_t total)>;

/// Calls body(i) once for each i in [0, count - 1], on `threads` threads (0: all cores) and in no
/// particular order; `progress` after each. `body` must be safe to run concurrently for different
/// i.
void for_each_index(size_t count, unsigned threads, const Progress& progress,
                    const std::function<void(size_t)>& body);

}  // namespace hmlfc::io
