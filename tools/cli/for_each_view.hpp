// Work on every view of a grid, on several threads.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>

#include <hmlfc/decoder.hpp>

#include "cli/output.hpp"
#include "io/parallel.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

/// The failure with the lowest index among many threads: the same in every run.
class FirstFailure {
 public:
  /// Calls `body` unless a failure of a lower index makes it pointless; keeps what it throws.
  template <class Body>
  void guard(size_t index, const Body& body) {
    {
      const std::scoped_lock lock(mutex_);
      if (failure_ && index > index_) return;
    }
    try {
      body();
    } catch (const Failure& failure) {
      const std::scoped_lock lock(mutex_);
      if (failure_ && index > index_) return;
      index_ = index;
      failure_ = failure;
    }
  }

  void rethrow() const {
    if (failure_) throw *failure_;
  }

 private:
  std::mutex mutex_;
  size_t index_ = 0;
  std::optional<Failure> failure_;
};

/// Calls body(view) once for each view of `grid`, on `threads` threads (0: all cores), in no
/// particular order. Throws the failure of the first view, row by row, that has one.
template <class Body>
void for_each_view(io::GridShape grid, int threads, const io::Progress& progress,
                   const Body& body) {
  FirstFailure first;
  const auto one_view = [&](size_t index) {
    const ViewPos view{static_cast<uint32_t>(index / grid.cols),
                       static_cast<uint32_t>(index % grid.cols)};
    first.guard(index, [&] { body(view); });
  };
  io::for_each_index(size_t{grid.rows} * grid.cols, static_cast<unsigned>(threads), progress,
                     one_view);
  first.rethrow();
}

}  // namespace hmlfc::cli
