// Maps internal results and exceptions to C status codes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <tl/expected.hpp>

#include <hmlfc/hmlfc.h>
#include <hmlfc/error.hpp>

namespace hmlfc::capi {

/// Why a function fails: what hmlfc_failure says of it.
struct Refusal {
  hmlfc_status status = HMLFC_STATUS_INTERNAL;
  Section section = Section::kHeader;
  uint64_t offset = 0;
  std::array<char, HMLFC_FAILURE_TEXT> text{};  ///< ends in 0
};

/// Nothing, or what went wrong.
using Outcome = tl::expected<void, Refusal>;

/// A refusal of the library's own. `text` is cut to what a failure holds; allocates nothing.
tl::unexpected<Refusal> refuse(hmlfc_status status, std::string_view text);

/// An error of annex A. Throws std::bad_alloc.
tl::unexpected<Refusal> refuse(const Error& error);

/// Bad argument `name`, and `what` is wrong with it.
tl::unexpected<Refusal> bad_argument(std::string_view name, std::string_view what);

/// Refuses a null pointer, the argument `name`.
Outcome check_pointer(const void* pointer, std::string_view name);

/// Whether `failure` is null or can be filled in.
bool is_usable(const hmlfc_failure* failure);

/// Fills in *failure, unless it is null, and returns the status.
int tell(hmlfc_failure* failure, const Outcome& outcome);

/// The refusal for the exception that is being handled.
Outcome refuse_exception() noexcept;

/// The status of body(), an Outcome, told to `failure`. No exception gets out.
template <class Body>
int answer(hmlfc_failure* failure, const Body& body) noexcept {
  if (!is_usable(failure)) return HMLFC_STATUS_BAD_ARGUMENT;
  try {
    return tell(failure, body());
  } catch (...) {
    return tell(failure, refuse_exception());
  }
}

}  // namespace hmlfc::capi
