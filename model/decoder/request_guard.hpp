// Wraps what every public request does: want of memory as a named error, as no exception crosses
// the library's interface, and the bytes of a partial source.
#pragma once

#include <new>

#include <hmlfc/byte_source.hpp>
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

/// Holds the bytes of a partial source as long as it lives; `source` may be null.
class HeldBytes {
 public:
  explicit HeldBytes(ByteSource* source) : source_(source) {
    if (source_ != nullptr) source_->begin_request();
  }
  HeldBytes(const HeldBytes&) = delete;
  HeldBytes& operator=(const HeldBytes&) = delete;
  ~HeldBytes() {
    if (source_ != nullptr) source_->end_request();
  }

 private:
  ByteSource* source_;
};

/// guard_memory of body(), which reads the stream of `source`, null where it is not partial. Where
/// the source has failed, whatever body() makes of it becomes bus_error: parts of the decoder take
/// a block with an error for one that says nothing.
template <class Body>
auto guard_request(ByteSource* source, const Body& body) -> decltype(body()) {
  if (source == nullptr) return guard_memory(body);
  const HeldBytes held(source);
  auto result = guard_memory(body);
  if (source->failure().empty()) return result;
  return fail(ErrorCode::kBusError, Section::kHeader, 0);
}

}  // namespace hmlfc
