// Want of memory as a named error: no exception crosses the library's interface.
#pragma once

#include <new>

#include <hmlfc/error.hpp>

namespace hmlfc {

/// The Result of body(), or out_of_memory if it throws std::bad_alloc.
template <class Body>
auto guard_memory(const Body& body) -> decltype(body()) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, Section::kHeader, 0);
  }
}

}  // namespace hmlfc
