// Running out of memory as a named error: no exception crosses the library's interface.
#pragma once

#include <new>

#include <hmlfc/error.hpp>

namespace hmlfc {

/// body(), a function that returns a Result; out_of_memory where it throws std::bad_alloc.
template <class Body>
auto guard_memory(const Body& body) -> decltype(body()) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, Section::kHeader, 0);
  }
}

}  // namespace hmlfc
