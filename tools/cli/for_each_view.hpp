// Work on every view of a grid, on several threads.
#pragma once

#include <cstddef>

#include <hmlfc/decoder.hpp>

#include "cli/output.hpp"
#include "io/parallel.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

using FirstFailure = io::FirstError<Failure>;

/// Calls `body` unless a failure of a lower index makes it pointless; keeps what it throws.
template <class Body>
void guard(FirstFailure& first, size_t index, const Body& body) {
  if (first.makes_pointless(index)) return;
  try {
    body();
  } catch (const Failure& failure) {
    first.add(index, failure);
  }
}

inline void rethrow(const FirstFailure& first) {
  if (first.error()) throw *first.error();
}

/// Calls body(view) once for each view of `grid`, on `threads` threads (0: all cores), in no
/// particular order. Throws the failure of the first view, row by row, that has one.
template <class Body>
void for_each_view(io::GridShape grid, int threads, const io::Progress& progress,
                   const Body& body) {
  FirstFailure first;
  const auto one_view = [&](size_t index) {
    const ViewPos view{static_cast<uint32_t>(index / grid.cols),
                       static_cast<uint32_t>(index % grid.cols)};
    guard(first, index, [&] { body(view); });
  };
  io::for_each_index(size_t{grid.rows} * grid.cols, static_cast<unsigned>(threads), progress,
                     one_view);
  rethrow(first);
}

}  // namespace hmlfc::cli
